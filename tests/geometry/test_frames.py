# SPDX-License-Identifier: BSD-3-Clause
"""Velocities in the frame of a moving observer."""

from pathlib import Path
from typing import Any

import pytest

import bubblesim
from bubblesim.geometry.frames import state_from, state_in

# The table turns about its z axis and faces y; both other models are 3 m ahead of it.
SCENE = """\
<?xml version="1.0"?>
<sdf version="1.9">
  <world name="turntable">
    <model name="Table"><pose>1 0 0 0 0 1.5707963267948966</pose><link name="link"/></model>
    <model name="Rider"><pose>1 3 0 0 0 1.5707963267948966</pose><link name="link"/></model>
    <model name="Post"><pose>1 3 0 0 0 0</pose><link name="link"/></model>
  </world>
</sdf>
"""


@pytest.fixture
def turntable(tmp_path: Path) -> Any:
    """A table that turns at 2 rad/s and carries the rider: w x r = (0, 0, 2) x (0, 3, 0) = (-6, 0, 0)."""
    file = tmp_path / "turntable.sdf"
    file.write_text(SCENE)
    simulation = bubblesim.Simulation(str(file))
    simulation.object("/Table").angular_velocity = [0, 0, 2]
    simulation.object("/Rider").angular_velocity = [0, 0, 2]
    simulation.object("/Rider").linear_velocity = [-6, 0, 0]
    return simulation


def seen_from_table(simulation: Any, path: str) -> tuple[list[float], list[float], list[float]]:
    return state_in(simulation.world, simulation.object(path).handle, simulation.object("/Table").handle)


def test_what_is_carried_along_rests(turntable: Any) -> None:
    pose, linear, angular = seen_from_table(turntable, "/Rider")
    assert pose == pytest.approx([3, 0, 0, 0, 0, 0, 1])
    assert linear == pytest.approx([0, 0, 0])
    assert angular == pytest.approx([0, 0, 0])


def test_what_stands_still_passes_the_other_way(turntable: Any) -> None:
    # -(0, 0, 2) x (3, 0, 0)
    _, linear, angular = seen_from_table(turntable, "/Post")
    assert linear == pytest.approx([0, -6, 0])
    assert angular == pytest.approx([0, 0, -2])


def test_the_world_sees_velocities_as_they_are(turntable: Any) -> None:
    _, linear, angular = state_in(turntable.world, turntable.object("/Rider").handle, None)
    assert linear == pytest.approx([-6, 0, 0])
    assert angular == pytest.approx([0, 0, 2])


def test_what_rests_on_a_turning_table_moves_with_it(turntable: Any) -> None:
    table = turntable.object("/Table").handle
    pose, linear, angular = state_from(turntable.world, [3, 0, 0, 0, 0, 0, 1], [0, 0, 0], [0, 0, 0], table)
    assert pose == pytest.approx(turntable.world.pose(turntable.object("/Rider").handle))
    assert linear == pytest.approx([-6, 0, 0])
    assert angular == pytest.approx([0, 0, 2])


def test_velocities_along_the_axes_of_a_frame_turn_with_it(turntable: Any) -> None:
    # At the table's centre the carried velocity is 0; the table faces y.
    table = turntable.object("/Table").handle
    _, linear, angular = state_from(turntable.world, [0, 0, 0, 0, 0, 0, 1], [5, 0, 0], [0, 1, 0], table)
    assert linear == pytest.approx([0, 5, 0])
    assert angular == pytest.approx([-1, 0, 2])
