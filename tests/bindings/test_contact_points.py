# SPDX-License-Identifier: BSD-3-Clause
"""The contact points that the window shows."""

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
