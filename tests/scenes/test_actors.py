# SPDX-License-Identifier: BSD-3-Clause
"""People of a world: a lidar sees them walk, and what runs into them stops."""

from pathlib import Path

import numpy as np
import pytest

import bubblesim

EYE = (
    '<model name="eye"><static>true</static><pose>0 0 {height} 0 0 0</pose><link name="body">'
    '<sensor name="scanner" type="lidar"><lidar><scan><horizontal><samples>5</samples>'
    "<min_angle>-0.02</min_angle><max_angle>0.02</max_angle></horizontal></scan>"
    "<range><min>0.1</min><max>20</max></range></lidar></sensor></link></model>"
)
WALK = (
    '<actor name="visitor"><pose>0 0 1 0 0 0</pose><script><loop>false</loop>'
    '<trajectory id="0" type="walking" tension="1">'
    "<waypoint><time>0</time><pose>6 0 0 0 0 3.14</pose></waypoint>"
    "<waypoint><time>2</time><pose>2 0 0 0 0 3.14</pose></waypoint></trajectory></script></actor>"
)


def world(folder: Path, *models: str) -> bubblesim.Simulation:
    ground = (
        '<model name="ground"><static>true</static><link name="l"><collision name="c"><geometry><plane/></geometry>'
        "</collision></link></model>"
    )
    (folder / "w.sdf").write_text(f'<sdf version="1.9"><world name="w">{ground}{"".join(models)}</world></sdf>')
    return bubblesim.Simulation(str(folder / "w.sdf"))


@pytest.mark.parametrize("height", [0.3, 1.0, 1.5])
def test_a_lidar_sees_a_person_who_walks(tmp_path: Path, height: float) -> None:
    simulation = world(tmp_path, EYE.format(height=height), WALK)
    scanner = simulation.object("/eye/body/scanner")
    for _ in range(4):
        simulation.step(10)
        part = simulation.time / 2.0
        place = 6.0 - 4.0 * (3 * part**2 - 2 * part**3)  # at rest at both ends
        ranges = np.asarray(scanner.reading.ranges)
        assert ranges.min() == pytest.approx(place - 0.25, abs=2e-3)


def test_what_runs_into_a_person_stops(tmp_path: Path) -> None:
    standing = '<actor name="visitor"><pose>1 0 0 0 0 0</pose></actor>'
    box = (
        '<model name="box"><pose>0 0 0.1 0 0 0</pose><link name="l"><inertial><inertia><ixx>.1</ixx><iyy>.1</iyy>'
        '<izz>.1</izz></inertia></inertial><collision name="c"><geometry><box><size>.2 .2 .2</size></box></geometry>'
        "<surface><friction><ode><mu>0</mu></ode></friction></surface></collision></link></model>"
    )
    simulation = world(tmp_path, standing, box)
    found = simulation.object("/box")
    found.linear_velocity = (1.0, 0.0, 0.0)
    simulation.step(40)
    assert float(found.position[0]) < 1.0 - 0.25 - 0.1 + 0.01


def test_a_person_is_a_model_of_the_world(tmp_path: Path) -> None:
    simulation = world(tmp_path, WALK)
    person = simulation.object("/visitor")
    simulation.step(60)
    assert [float(x) for x in person.position] == pytest.approx([2.0, 0.0, 0.0])
    state = simulation.save()
    simulation.reset()
    assert float(person.position[0]) == 6.0
    simulation.restore(state)
    assert float(person.position[0]) == pytest.approx(2.0)
