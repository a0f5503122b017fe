# SPDX-License-Identifier: BSD-3-Clause
"""The joystick node, with a named pipe in place of a joystick."""

import os
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path

import pytest

from bubblesim.teleop.joystick import AXIS, BUTTON, EVENT, INITIAL
from ros_support import DEADLINE, REPOSITORY, RosCore, start, stop, stopped_on_failure, wait_until
from velocities import Velocities

NODE = [sys.executable, str(REPOSITORY / "scripts" / "joy_teleop.py")]


def event(kind: int, number: int, value: int) -> bytes:
    return EVENT.pack(0, value, kind, number)


class Stick:
    """A pipe that the node reads."""

    def __init__(self, core: RosCore, folder: Path, *arguments: str) -> None:
        self._pipe = folder / "js0"
        self._turned = False
        os.mkfifo(self._pipe)
        self.received = Velocities(core, folder / "received")
        self._node = start([*NODE, f"_dev:={self._pipe}", *arguments], core.env)
        with stopped_on_failure(self._node):
            self.plug_in()
            wait_until(self._has_received, "a subscriber", timeout=3 * DEADLINE)

    def _has_received(self) -> bool:
        # Messages before the subscriber connects are lost, and the node sends what is other than before.
        self._turned = not self._turned
        self.send(event(BUTTON, 4, 1), event(AXIS, 3, 32767 if self._turned else 0))
        return bool(self.received.all())

    def plug_in(self) -> None:
        self._end = os.open(self._pipe, os.O_WRONLY)  # waits for the node

    def unplug(self) -> None:
        os.close(self._end)

    def send(self, *events: bytes) -> None:
        os.write(self._end, b"".join(events))

    def close(self) -> None:
        stop(self._node)
        self.received.close()


@pytest.fixture
def stick(roscore: RosCore, tmp_path: Path) -> Iterator[Stick]:
    stick = Stick(roscore, tmp_path, "_speed:=0.5", "_turn:=2.0", "_axis_angular:=3", "_enable_button:=4")
    yield stick
    stick.close()


def test_the_stick_drives_while_the_button_is_held_and_the_joystick_is_there(stick: Stick) -> None:
    stick.send(event(AXIS, 1, -32767), event(AXIS, 3, 0), event(BUTTON, 4, 1))
    wait_until(lambda: stick.received.last() == (0.5, 0.0), "the robot to drive")
    stick.send(event(AXIS, 3, 32767))
    wait_until(lambda: stick.received.last() == (0.5, -2.0), "the robot to turn right")
    stick.send(event(BUTTON, 4, 0))
    wait_until(lambda: stick.received.last() == (0.0, 0.0), "the robot to stop")
    stick.send(event(BUTTON, 4, 1))
    wait_until(lambda: stick.received.last() == (0.5, -2.0), "the robot to drive again")
    stick.unplug()
    wait_until(lambda: stick.received.last() == (0.0, 0.0), "the robot to stop when the joystick is gone")
    stick.plug_in()
    stick.send(event(AXIS | INITIAL, 1, 32767), event(BUTTON | INITIAL, 4, 1))
    wait_until(lambda: stick.received.last() == (-0.5, 0.0), "the robot to drive back")


def test_it_waits_for_a_joystick_and_logs_so(roscore: RosCore, tmp_path: Path) -> None:
    log = tmp_path / "log"
    with log.open("w") as output:
        node = start([*NODE, "_dev:=/nowhere/js0"], roscore.env, stdout=output, stderr=subprocess.STDOUT)
    wait_until(lambda: "waiting for a joystick" in log.read_text(), "the line about it")
    stop(node)
    assert "/nowhere/js0" in log.read_text()


@pytest.mark.parametrize("argument", ["_rate:=0", "_speed:=fast", "_dead_zone:=2"])
def test_parameters_that_cannot_be_are_reported(roscore: RosCore, argument: str) -> None:
    run = subprocess.run(
        [*NODE, argument], env=roscore.env, capture_output=True, text=True, timeout=3 * DEADLINE, check=False
    )
    assert run.returncode == 2
    assert "invalid parameter of" in run.stdout + run.stderr
    assert "Traceback" not in run.stderr
