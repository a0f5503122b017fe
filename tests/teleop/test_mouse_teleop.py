# SPDX-License-Identifier: BSD-3-Clause
"""The mouse node on its own display."""

import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path

import pytest

from display_support import Display
from ros_support import DEADLINE, REPOSITORY, RosCore, start, stop, wait_until
from velocities import Velocities

NODE = [sys.executable, str(REPOSITORY / "scripts" / "mouse_teleop.py"), "_speed:=1.0", "_turn:=2.0", "_dead_zone:=0"]


@pytest.fixture
def display(roscore: RosCore) -> Iterator[Display]:
    with Display(roscore.env) as display:
        yield display


def test_dragging_drives_and_releasing_stops(display: Display, roscore: RosCore, tmp_path: Path) -> None:
    received = Velocities(roscore, tmp_path / "received")
    node = start(NODE, display.env)
    wait_until(lambda: bool(display.windows("mouse_teleop")), "the window")
    (window,) = display.windows("mouse_teleop")

    def drag_until_received() -> bool:  # messages before the subscriber connects are lost
        display.xdotool("mousemove", "--window", window, 150, 140, "mousedown", 1, "mousemove_relative", 0, -10)
        return bool(received.all())

    wait_until(drag_until_received, "a subscriber", timeout=3 * DEADLINE)
    display.xdotool("mousemove", "--window", window, 225, 75)
    wait_until(lambda: received.last() == pytest.approx((0.5, -1.0), abs=0.03), "half ahead, half to the right")
    count = len(received.all())
    wait_until(lambda: len(received.all()) > count + 3, "repeated commands")
    display.xdotool("mousemove", "--window", window, 150, 800)  # outside the window
    wait_until(lambda: received.last() == pytest.approx((-1.0, 0.0), abs=0.03), "full speed back")
    display.xdotool("mouseup", 1)
    wait_until(lambda: received.last() == (0.0, 0.0), "the robot to stop")
    stop(node)
    received.close()


def test_without_a_display_it_reports_that(roscore: RosCore) -> None:
    env = {**roscore.env, "DISPLAY": ""}
    run = subprocess.run(NODE, env=env, capture_output=True, text=True, timeout=3 * DEADLINE, check=False)
    assert run.returncode == 2
    assert "cannot open a window" in run.stderr
    assert "Traceback" not in run.stderr
