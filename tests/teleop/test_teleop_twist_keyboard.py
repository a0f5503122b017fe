# SPDX-License-Identifier: BSD-3-Clause
"""The keyboard node in its own terminal."""

import os
import pty
import signal
import subprocess
import sys
import termios
from collections.abc import Iterator
from pathlib import Path

import pytest

from ros_support import DEADLINE, REPOSITORY, RosCore, start, stop, wait_until
from velocities import Velocities

NODE = [sys.executable, str(REPOSITORY / "scripts" / "teleop_twist_keyboard.py")]


class Terminal:
    """A terminal that runs the node, and the node's commands."""

    def __init__(self, core: RosCore, folder: Path, *arguments: str) -> None:
        self._keys, self.screen = pty.openpty()
        self._received = Velocities(core, folder / "received")
        self._shown = folder / "shown"
        with self._shown.open("w") as output:
            self.process = start([*NODE, *arguments], core.env, stdin=self.screen, stdout=output)
        wait_until(lambda: "speed" in self.shown, "the speeds to be shown")
        wait_until(lambda: self._has_received(), "a subscriber", timeout=3 * DEADLINE)

    def _has_received(self) -> bool:
        self.press("k")  # messages before the subscriber connects are lost
        return self.last() is not None

    @property
    def shown(self) -> str:
        return self._shown.read_text()

    def press(self, keys: str) -> None:
        os.write(self._keys, keys.encode())

    def last(self) -> tuple[float, float] | None:
        """Return forward and turning velocity of the last command."""
        return self._received.last()

    def close(self) -> None:
        stop(self.process)
        self._received.close()
        os.close(self._keys)
        os.close(self.screen)


@pytest.fixture
def terminal(roscore: RosCore, tmp_path: Path) -> Iterator[Terminal]:
    terminal = Terminal(roscore, tmp_path, "_speed:=0.4")
    yield terminal
    terminal.close()


def test_a_key_drives_for_a_moment(terminal: Terminal) -> None:
    wait_until(lambda: terminal.press("u") or terminal.last() == (0.4, 1.0), "a command")
    wait_until(lambda: terminal.last() == (0.0, 0.0), "a stop")


def test_speeds_are_shown_when_they_change(terminal: Terminal) -> None:
    terminal.press("w")
    wait_until(lambda: "speed 0.44 m/s   turn 1 rad/s" in terminal.shown, "the new speed")


def test_the_end_stops_the_robot_and_leaves_the_terminal_as_it_was(roscore: RosCore, tmp_path: Path) -> None:
    terminal = Terminal(roscore, tmp_path, "--latch")
    terminal.press("i")
    wait_until(lambda: terminal.last() == (0.5, 0.0), "a command")
    terminal.process.send_signal(signal.SIGINT)
    assert terminal.process.wait(timeout=DEADLINE) == 0
    wait_until(lambda: terminal.last() == (0.0, 0.0), "a stop")
    assert termios.tcgetattr(terminal.screen)[3] & termios.ECHO
    terminal.close()


def test_without_a_terminal_it_reports_that(roscore: RosCore) -> None:
    run = subprocess.run(
        NODE, env=roscore.env, stdin=subprocess.DEVNULL, capture_output=True, text=True, timeout=60, check=False
    )
    assert run.returncode == 2
    assert "stdin is not a terminal" in run.stderr
