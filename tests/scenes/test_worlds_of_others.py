# SPDX-License-Identifier: BSD-3-Clause
"""Third-party Gazebo worlds and robots, in the folders BUBBLESIM_BARN (worlds) and BUBBLESIM_ROBOTS (packages): each
loads, runs, and stays on the ground."""

import os
from pathlib import Path

import numpy as np
import pytest

import bubblesim

ROBOTS = (
    "rrbot_description/urdf/rrbot.xacro",
    "turtlebot3_description/urdf/turtlebot3_burger.urdf",
    "turtlebot3_description/urdf/turtlebot3_waffle.urdf",
    "turtlebot3_description/urdf/turtlebot3_waffle_pi.urdf",
)
"""Self-contained robots; the others need packages that are not installed."""


def folder(variable: str) -> Path | None:
    return Path(os.environ[variable]) if os.environ.get(variable) else None


def files() -> list[Path]:
    barn, robots = folder("BUBBLESIM_BARN"), folder("BUBBLESIM_ROBOTS")
    found = sorted(barn.glob("*.world")) if barn else []
    if robots:
        found += sorted(robots.rglob("*.world")) + [robots / robot for robot in ROBOTS]
    return found


FILES = files()
pytestmark = pytest.mark.skipif(not FILES, reason="BUBBLESIM_BARN and BUBBLESIM_ROBOTS name no folders")


@pytest.mark.parametrize("file", FILES, ids=lambda file: file.name)
def test_it_loads_and_runs(file: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    robots = folder("BUBBLESIM_ROBOTS")
    if robots:
        monkeypatch.setenv("ROS_PACKAGE_PATH", f"{robots}:{os.environ.get('ROS_PACKAGE_PATH', '')}")
    simulation = bubblesim.Simulation(str(file))
    simulation.step(round(1.0 / simulation.time_step))
    for thing in simulation.objects:
        assert np.isfinite([*thing.position, *thing.orientation]).all(), thing.path
