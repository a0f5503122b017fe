# SPDX-License-Identifier: BSD-3-Clause
"""Fixtures of pytest: `ros_master`, `controller` and `sim`.

``bubblesim test`` has them; for pytest itself, a conftest.py names them: pytest_plugins = ["bubblesim.testing.plugin"].
"""

from __future__ import annotations

import itertools
import os
import shlex
import signal
from collections.abc import Callable, Iterator
from pathlib import Path

import pytest

from bubblesim.running.processes import Program, Programs
from bubblesim.testing.master import Master, start_master
from bubblesim.testing.simulator import Simulator


def pytest_configure(config: pytest.Config) -> None:
    """A closed terminal ends the tests as Ctrl-C does, with all that they have started."""
    if signal.getsignal(signal.SIGHUP) == signal.SIG_DFL:
        signal.signal(signal.SIGHUP, signal.default_int_handler)


StartController = Callable[..., Program]
StartSimulator = Callable[..., Simulator]


@pytest.fixture
def _programs(tmp_path: Path) -> Iterator[Programs]:
    """What runs for a test, and ends with it."""
    with Programs(tmp_path) as programs:
        yield programs


@pytest.fixture
def ros_master(_programs: Programs, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Master:
    """A ROS master of the test's own, on simulated time; this process and those that it starts use it."""
    monkeypatch.setenv("ROS_LOG_DIR", str(tmp_path / "ros_log"))
    monkeypatch.setenv("PATH", f"/usr/bin:{os.environ.get('PATH', '')}")  # ROS is built for Debian's Python
    master = start_master(_programs)
    for name, value in master.environment.items():
        monkeypatch.setenv(name, value)
    return master


@pytest.fixture
def controller(ros_master: Master, _programs: Programs) -> StartController:
    """Starts a controller: ``controller("rosrun my_package my_node.py _gain:=2")``."""

    def start(command: str) -> Program:
        return _programs.start(f"controller {shlex.split(command)[-1].rpartition('/')[2]}", *shlex.split(command))

    return start


@pytest.fixture
def sim(ros_master: Master, _programs: Programs, tmp_path: Path) -> StartSimulator:
    """Starts a simulator: ``sim("tricycle", lockstep=["/speed", "/steering"])``; see Simulator."""
    numbers = itertools.count(1)

    def start(scene: str, lockstep: tuple[str, ...] = (), seed: int = 0, options: tuple[str, ...] = ()) -> Simulator:
        bag = tmp_path / f"run{next(numbers)}.bag"
        return Simulator(ros_master, _programs, bag, scene, lockstep, seed, options)

    return start
