# SPDX-License-Identifier: BSD-3-Clause
"""The contact points of a world."""

from pathlib import Path

import numpy as np
import pytest

from bubblesim import Simulation

SCENE = """\
<sdf version="1.9"><world name="w">
  <model name="ground"><static>true</static><link name="link">
    <collision name="c"><geometry><plane/></geometry></collision>
  </link></model>
  <model name="box"><pose>3 1 0.2 0 0 0</pose><link name="link">
    <inertial><mass>2</mass><inertia><ixx>0.05</ixx><iyy>0.05</iyy><izz>0.05</izz></inertia></inertial>
    <collision name="c"><geometry><box><size>0.4 0.4 0.4</size></box></geometry></collision>
  </link></model>
</world></sdf>
"""


def test_the_points_carry_the_weight_of_a_box_at_its_lower_corners(tmp_path: Path) -> None:
    file = tmp_path / "box.sdf"
    file.write_text(SCENE)
    simulation = Simulation(str(file))
    for _ in range(100):  # it sleeps then
        simulation.step()
    points = np.array(simulation.world.contact_points())
    corners = {(3.2, 1.2), (3.2, 0.8), (2.8, 1.2), (2.8, 0.8)}
    assert {(round(x, 2), round(y, 2)) for x, y in points[:, :2].tolist()} == corners
    np.testing.assert_allclose(points[:, 2], 0, atol=1e-3)
    assert points[:, 3].sum() == pytest.approx(2 * 9.8, rel=1e-3)


def test_the_forces_at_the_points_carry_weight_and_friction(tmp_path: Path) -> None:
    """In a gravity that leans by less than the friction, the ground's force on the box is minus its weight."""
    file = tmp_path / "box.sdf"
    file.write_text(SCENE.replace('<world name="w">', '<world name="w"><gravity>3 0 -9</gravity>'))
    simulation = Simulation(str(file))
    for _ in range(100):
        simulation.step()
    world = simulation.world
    ground, box = (world.find(f"/{name}/link") for name in ("ground", "box"))
    for one, other, sign in ((box, ground, 1), (ground, box, -1)):
        points = [world.contact_point(index, [one]) for index in range(5)]
        assert points[4] is None
        assert {point[:2] for point in points[:4]} == {(one, other)}
        np.testing.assert_allclose([point[4] for point in points[:4]], [(0, 0, sign)] * 4, atol=1e-9)
        force = np.sum([point[3] for point in points[:4]], axis=0)
        np.testing.assert_allclose(force, sign * 2 * np.array([-3, 0, 9]), atol=0.02)
    assert world.contact_point(0, [-1]) is None
