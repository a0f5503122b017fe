# SPDX-License-Identifier: BSD-3-Clause
"""Pytest fixtures: `ros_master`, `controller` and `sim`; for ROS 2 `ros2_domain`, `ros2_controller` and `ros2_sim`.

``bubblesim test`` loads them; for plain pytest, add to conftest.py: pytest_plugins = ["bubblesim.testing.plugin"].
With ``--keep-failed FOLDER``, what a failed test leaves is kept for those who did not see it run, such as an artifact
of a CI: the bags, the logs of its programs, and a plot of the robot's path.
"""

from __future__ import annotations

import itertools
import os
import shlex
import signal
import sys
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import TYPE_CHECKING, Any

import pytest

from bubblesim.running.isolation import reserve_domain
from bubblesim.running.processes import Program, Programs
from bubblesim.testing.kept_files import keep
from bubblesim.testing.master import Master, start_master
from bubblesim.testing.ros2_domain import Ros2Domain, without_ros1
from bubblesim.testing.simulator import Simulator

if TYPE_CHECKING:
    from bubblesim.testing.ros2_simulator import Ros2Simulator


def pytest_configure(config: pytest.Config) -> None:
    """Check that this Python can load bubblesim, and let a closed terminal end the tests as Ctrl-C does."""
    try:
        from bubblesim import _core  # noqa: F401
    except ImportError as error:
        raise pytest.UsageError(
            f"{sys.executable} cannot load bubblesim: {error} -- `bubblesim test` runs tests with a Python that can"
        ) from None
    if signal.getsignal(signal.SIGHUP) == signal.SIG_DFL:
        signal.signal(signal.SIGHUP, signal.default_int_handler)


StartController = Callable[..., Program]
StartSimulator = Callable[..., Simulator]
StartRos2Simulator = Callable[..., "Ros2Simulator"]


_FAILED = pytest.StashKey[bool]()


def pytest_addoption(parser: pytest.Parser) -> None:
    """Add the option of the plugin."""
    parser.addoption(
        "--keep-failed",
        metavar="FOLDER",
        type=Path,
        help="keep the bags and logs of failed tests in FOLDER/TEST, with a plot of the robot's path",
    )


@pytest.hookimpl(hookwrapper=True)  # type: ignore[untyped-decorator, unused-ignore]  # by pytest 7; 8 has types
def pytest_runtest_makereport(item: pytest.Item) -> Iterator[None]:
    """Note that a test has failed; its fixtures end later."""
    outcome: Any = yield
    item.stash[_FAILED] = item.stash.get(_FAILED, False) or outcome.get_result().failed


@pytest.fixture
def _programs(tmp_path: Path, request: pytest.FixtureRequest) -> Iterator[Programs]:
    """Provide the programs of a test, which end with it."""
    with Programs(tmp_path) as programs:
        yield programs
    folder: Path | None = request.config.getoption("--keep-failed", None)  # a plugin that loads late has none
    if folder is not None and request.node.stash.get(_FAILED, False):
        kept = keep(tmp_path, folder, request.node.name)
        request.node.user_properties.append(("kept", str(kept)))  # also in the file of --junitxml


@pytest.fixture
def ros_master(_programs: Programs, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Master:
    """Start a ROS master for the test, on simulated time; this process and its child processes use it."""
    monkeypatch.setenv("ROS_LOG_DIR", str(tmp_path / "ros_log"))
    monkeypatch.setenv("PATH", f"/usr/bin:{os.environ.get('PATH', '')}")  # ROS is built for Debian's Python
    master = start_master(_programs)
    for name, value in master.environment.items():
        monkeypatch.setenv(name, value)
    return master


@pytest.fixture
def controller(ros_master: Master, _programs: Programs) -> StartController:
    """Return a function that starts a controller: ``controller("rosrun my_package my_node.py _gain:=2")``."""

    return lambda command: _programs.start(_name_of(command), *shlex.split(command))


def _name_of(controller: str) -> str:
    return f"controller {shlex.split(controller)[-1].rpartition('/')[2]}"


@pytest.fixture
def sim(ros_master: Master, _programs: Programs, tmp_path: Path) -> StartSimulator:
    """Return a function that starts a Simulator: ``sim("tricycle", lockstep=["/speed", "/steering"])``."""
    numbers = itertools.count(1)

    def start(scene: str, lockstep: tuple[str, ...] = (), seed: int = 0, options: tuple[str, ...] = ()) -> Simulator:
        bag = tmp_path / f"run{next(numbers)}.bag"
        return Simulator(ros_master, _programs, bag, scene, lockstep, seed, options)

    return start


@pytest.fixture
def ros2_domain(monkeypatch: pytest.MonkeyPatch) -> Iterator[Ros2Domain]:
    """Take a ROS 2 domain for the test; this process and its child processes use it."""
    number, holder = reserve_domain()
    with holder:
        domain = Ros2Domain(number)
        for name, value in domain.environment.items():
            monkeypatch.setenv(name, value)
        yield domain


@pytest.fixture
def ros2_controller(ros2_domain: Ros2Domain, _programs: Programs) -> StartController:
    """Return a function that starts a node of ROS 2: ``ros2_controller("ros2 run my_package my_node")``."""
    environment = without_ros1({**os.environ, **ros2_domain.environment})
    return lambda command: _programs.start(_name_of(command), *shlex.split(command), environment=environment)


@pytest.fixture
def ros2_sim(ros2_domain: Ros2Domain, _programs: Programs, tmp_path: Path) -> StartRos2Simulator:
    """Return a function that starts a Ros2Simulator: ``ros2_sim("tricycle", lockstep=["/speed", "/steering"])``."""
    # Not before pytest_configure() has found out whether this Python can load the module.
    from bubblesim.testing.ros2_simulator import Ros2Simulator

    numbers = itertools.count(1)

    def start(
        scene: str, lockstep: tuple[str, ...] = (), seed: int = 0, options: tuple[str, ...] = ()
    ) -> Ros2Simulator:
        bag = tmp_path / f"run{next(numbers)}.mcap"
        return Ros2Simulator(_programs, bag, scene, lockstep, seed, options)

    return start
