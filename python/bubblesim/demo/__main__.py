# SPDX-License-Identifier: BSD-3-Clause
"""Runs a scene with its controller, shows how it is going, and leaves a picture and no process behind."""

from __future__ import annotations

import argparse
import contextlib
import os
import signal
import sys
import tempfile
import time
import urllib.parse
import xmlrpc.client
from collections.abc import Callable, Iterator
from pathlib import Path

import rosgraph
import rosgraph.network

from bubblesim.demo.processes import DemoError, Programs
from bubblesim.demo.recording import Recording

_CONTROLLERS = {"tricycle": "tricycle_avoid.py"}  # the other scenes start their own, or need none
_SIMULATOR_NODE = "/sim_ros_interface"
_STARTING_PATIENCE = 30.0  # s
_LEAST_DISTANCE = 0.01  # m: less is standing still


class Stop:
    """Becomes true at the first SIGINT or SIGTERM."""

    def __init__(self) -> None:
        """Takes both signals over."""
        self.requested = False
        for number in (signal.SIGINT, signal.SIGTERM):
            signal.signal(number, self._request)

    def _request(self, number: int, frame: object) -> None:
        self.requested = True


def wait_for(condition: Callable[[], bool], what: str, programs: Programs, stop: Stop) -> None:
    """Returns when the condition holds or a stop is requested; DemoError when it takes too long."""
    deadline = time.monotonic() + _STARTING_PATIENCE
    while not condition() and not stop.requested:
        programs.check()
        if time.monotonic() > deadline:
            raise DemoError(f"waited {_STARTING_PATIENCE:.0f} s in vain for {what}")
        time.sleep(0.05)


def simulator_runs() -> bool:
    """Whether the simulator's node is alive; a master also knows nodes that were killed."""
    try:
        uri = rosgraph.Master("/bubblesim_demo").lookupNode(_SIMULATOR_NODE)
        xmlrpc.client.ServerProxy(uri).getPid("/bubblesim_demo")
    except (OSError, rosgraph.MasterError):
        return False
    return True


def provide_master(programs: Programs, stop: Stop) -> None:
    """Starts a roscore unless one answers at ROS_MASTER_URI."""
    if rosgraph.is_master_online():
        if simulator_runs():
            raise DemoError(f"a simulator runs already on {rosgraph.get_master_uri()}: end it first")
        return
    uri = urllib.parse.urlparse(rosgraph.get_master_uri())
    if not rosgraph.network.is_local_address(uri.hostname or ""):
        raise DemoError(f"no master answers at {uri.geturl()}: start it there, or unset ROS_MASTER_URI")
    print(f"starting a roscore, as none answers at {uri.geturl()}", flush=True)
    programs.start("roscore", "roscore", "-p", str(uri.port or 11311))
    wait_for(rosgraph.is_master_online, f"a master at {uri.geturl()}", programs, stop)


@contextlib.contextmanager
def simulated_time() -> Iterator[None]:
    """Tells all nodes to take their time from /clock, and takes that back at the end."""
    master = rosgraph.Master("/bubblesim_demo")
    before = master.getParam("/use_sim_time") if master.hasParam("/use_sim_time") else None
    master.setParam("/use_sim_time", True)
    try:
        yield
    finally:
        with contextlib.suppress(OSError, rosgraph.MasterError):
            if before is None:
                master.deleteParam("/use_sim_time")
            else:
                master.setParam("/use_sim_time", before)


def watch(recording: Recording, seconds: float, programs: Programs, stop: Stop) -> None:
    """Prints how it is going until the time is over or a stop is requested: on a terminal in one line, updated."""
    on_terminal = sys.stdout.isatty()
    end = time.monotonic() + seconds
    next_line = 0.0
    while not stop.requested and time.monotonic() < end:
        programs.check()
        if time.monotonic() >= next_line:
            next_line = time.monotonic() + (0.5 if on_terminal else 2.0)
            print(f"\r\033[K{recording.live_line()}" if on_terminal else recording.live_line(), end="", flush=True)
            print(end="" if on_terminal else "\n", flush=True)
        time.sleep(0.05)
    if on_terminal:
        print()


def run(scene: str, seconds: float, picture: Path) -> None:
    """The whole demonstration."""
    stop = Stop()
    recording = Recording()
    with tempfile.TemporaryDirectory(prefix="bubblesim-demo-") as logs, Programs(Path(logs)) as programs:
        provide_master(programs, stop)
        with simulated_time():
            from bubblesim.demo.observer import Observer  # a ROS node: only once there is a master

            observer = Observer(recording)
            programs.start("simulator", "rosrun", "bubblesim", "sim", scene)
            controller = _CONTROLLERS.get(Path(scene).stem)
            if controller:
                programs.start("controller", "rosrun", "bubblesim", controller)
            wait_for(lambda: len(recording.samples) > 1, "the robot's pose on /tf", programs, stop)
            if recording.samples:
                watch(recording, seconds, programs, stop)
            observer.close()
    if len(recording.samples) < 2:
        raise DemoError("stopped before the robot's pose was known")
    from bubblesim.demo.picture import draw  # matplotlib takes its time: not while something is to be seen

    draw(scene, recording, picture)
    print(f"{recording.summary()}\npicture            {picture}", flush=True)
    if recording.distance() < _LEAST_DISTANCE and not stop.requested:
        raise DemoError("nothing moved")


def main() -> int:
    """Runs the demonstration; 0 when it went well, 1 when not."""
    parser = argparse.ArgumentParser(prog="scripts/demo", description=__doc__)
    parser.add_argument("scene", nargs="?", default="tricycle", help="name of a scene or path of an .sdf file")
    parser.add_argument("--seconds", type=float, default=float("inf"), help="end after so many seconds")
    arguments = parser.parse_args()
    os.environ.setdefault("ROS_HOSTNAME", "localhost")  # a machine's own name need not resolve
    try:
        run(arguments.scene, arguments.seconds, Path.cwd() / f"demo-{Path(arguments.scene).stem}.png")
    except DemoError as error:
        print(f"demo: {error}", file=sys.stderr)
        return 1
    return 0


if __name__ == "__main__":
    sys.exit(main())
