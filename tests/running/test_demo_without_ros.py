# SPDX-License-Identifier: BSD-3-Clause
"""The demo without ROS, which the wheel has."""

import re
import subprocess
from pathlib import Path

import pytest

from ros_support import built


def demo(folder: Path, *arguments: str) -> "subprocess.CompletedProcess[str]":
    command = [str(built("bubblesim")), "demo", "--no-ros", *arguments]
    return subprocess.run(command, cwd=folder, capture_output=True, text=True, check=False)


def test_the_tricycle_drives_around_obstacles_and_leaves_a_picture(tmp_path: Path) -> None:
    run = demo(tmp_path, "--seconds", "30")
    assert run.returncode == 0, run.stderr
    assert (tmp_path / "demo-tricycle.png").read_bytes().startswith(b"\x89PNG")
    duration, distance, closest = (
        float(re.search(rf"{name} +([0-9.]+)", run.stdout)[1])
        for name in ("simulated time", "distance driven", "closest echo")
    )
    assert duration == pytest.approx(30.0, abs=0.1)
    assert 0.15 * 30.0 < distance <= 0.3 * 30.0  # m: 0.5 to 1 rad/s of a wheel of 0.3 m
    assert closest > 0.1


def test_other_scenes_need_their_scripts(tmp_path: Path) -> None:
    run = demo(tmp_path, "bubblerob")
    assert (run.returncode, run.stderr) == (
        2,
        "error: --no-ros is for tricycle; for others: bubblesim run bubblerob --no-ros\n",
    )
