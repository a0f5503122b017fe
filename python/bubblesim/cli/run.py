# SPDX-License-Identifier: BSD-3-Clause
"""bubblesim run: run a scene, optionally with a ROS master and a controller."""

from __future__ import annotations

import argparse
import contextlib
import itertools
import os
import shlex
import subprocess
import sys
import tempfile
import time
from pathlib import Path
from typing import TYPE_CHECKING, Any

from bubblesim.running.places import node_program
from bubblesim.running.processes import Program, Programs, RunError
from bubblesim.running.stop import Stop

if TYPE_CHECKING:
    from bubblesim.running.paused_start import PausedStart

_DESCRIPTION = """\
Runs a scene in the simulator's node until Ctrl-C or for the time given by --until. All options of the node, listed
below, are accepted after the scene's name.

  bubblesim run tricycle                               with a roscore that runs already
  bubblesim run tricycle --roscore --speed 2           with its own roscore, twice as fast as real time
  bubblesim run ./mine.sdf --no-ros --until 10         a scene of your own, 10 s, without ROS
  bubblesim run tricycle --isolated --web              beside other runs and users of this machine
  bubblesim run robot.xacro wheels:=4 --roscore        with an argument for xacro
  bubblesim run tricycle --roscore --controller "rosrun bubblesim tricycle_avoid.py" --until 60 --plot path.png"""

_PLOTS = (".png", ".pdf", ".svg")
_WAITING = {"--paused", "--remote"}  # options with which the simulation waits for others


def add_parser(commands: Any) -> None:
    """Add the command's arguments."""
    parser: argparse.ArgumentParser = commands.add_parser(
        "run",
        help="run a scene",
        description=_DESCRIPTION,
        formatter_class=argparse.RawDescriptionHelpFormatter,
        usage="bubblesim run SCENE [option ...]",
        add_help=False,
        allow_abbrev=False,
    )
    parser.add_argument(
        "scene", metavar="SCENE", help="name of a scene, see `bubblesim scenes`, or path of an .sdf file"
    )
    parser.add_argument("-h", "--help", action=_Help, nargs=0, help="show this help and the options of the node")
    parser.add_argument("--roscore", action="store_true", help="start a roscore on simulated time if none is running")
    parser.add_argument(
        "--isolated",
        action="store_true",
        help="use a roscore, a ROS 2 domain and ports of its own, so that several runs and users share a machine",
    )
    parser.add_argument("--controller", metavar="COMMAND", type=shlex.split, help="also start this controller")
    parser.add_argument("--plot", metavar="FILE", type=Path, help="plot the robot's path to a .png, .pdf or .svg file")
    parser.set_defaults(command=_run, parser=parser, other_options=[])


class _Help(argparse.Action):
    """Print the help of this command, then that of the node."""

    def __call__(self, parser: argparse.ArgumentParser, *_arguments: object, **_named: object) -> None:
        parser.print_help()
        print("\nOptions of the node:\n", flush=True)
        subprocess.run([node_program(), "--help"], check=False)
        parser.exit()


def _run(options: argparse.Namespace) -> int:
    given = options.all_arguments
    if options.other_options and given.index(options.other_options[0]) < given.index(options.scene):
        raise ValueError("the scene comes first: bubblesim run SCENE [option ...]")
    _check_arguments(options)
    if options.isolated:
        _isolate(options)
    node = [str(node_program()), options.scene, *options.other_options]
    os.environ.setdefault("ROS_HOSTNAME", "localhost")  # the machine's host name may not resolve
    if not (options.roscore or options.controller or options.plot):
        sys.stdout.flush()
        os.execv(node[0], node)
    return _run_with_programs(options, node)


def _check_arguments(options: argparse.Namespace) -> None:
    """Refuse what would fail later; raise ValueError."""
    scene = Path(options.scene)
    if scene.suffix == ".launch":
        raise ValueError(f"{scene} is a launch file, not a scene: roslaunch bubblesim {scene.name}")
    if scene.is_dir() and (options.scene in (".", "..") or "/" in options.scene):  # a name may be that of a folder
        raise ValueError(f"{scene} is a folder, not a scene: give the .sdf file in it, or a name of `bubblesim scenes`")
    if options.plot is None:
        return
    if options.plot.suffix not in _PLOTS:
        raise ValueError(f"--plot: {options.plot} does not end with {' or '.join(_PLOTS)}, the formats of pictures")
    if not options.plot.absolute().parent.is_dir():
        raise ValueError(f"--plot: there is no folder {options.plot.parent}: make it first")


def _isolate(options: argparse.Namespace) -> None:
    """Give the run a master, a domain and a port for remote clients of its own, and print how others reach it."""
    from bubblesim.running.isolation import isolate

    others = options.other_options
    print(f"info: in other terminals: {isolate()}", file=sys.stderr, flush=True)
    without_master = "--no-ros" in others or "--ros=2" in others or ("--ros", "2") in itertools.pairwise(others)
    options.roscore = not without_master
    for option, value in itertools.pairwise([*others, ""]):
        if option == "--remote" and not value.isdigit():  # a free port, which the node prints
            others[others.index(option)] = "--remote=0"


def _run_with_programs(options: argparse.Namespace, node: list[str]) -> int:
    from bubblesim.running.master import provide_master, require_master, simulated_time
    from bubblesim.running.ros_home import use_writable_ros_home

    stop = Stop()
    with contextlib.ExitStack() as stack:
        logs = stack.enter_context(tempfile.TemporaryDirectory(prefix="bubblesim-run-"))
        programs = stack.enter_context(Programs(Path(logs)))
        use_writable_ros_home()
        if not options.roscore:
            require_master()
        elif provide_master(programs, stop):
            if stop.requested:
                return 0
            stack.enter_context(simulated_time())
        path = _Path(options.scene, options.plot) if options.plot else None
        if path and not any(option.partition("=")[0] in _WAITING for option in options.other_options):
            node.append("--paused")  # until the path is observed: a short run at full speed ends before
            path.start_paused()
        others = list(programs.running)
        simulator = programs.start("simulator", *node, shown=True)
        if options.controller:
            others.append(_start_controller(programs, options.controller))
        _wait(simulator, others, stop, path)
    if path:
        path.draw()
    code = simulator.exit_code or 0
    return max(code, 0) if stop.requested else code  # it may have received the signal before it installed its handler


def _start_controller(programs: Programs, command: list[str]) -> Program:
    try:
        return programs.start("controller", *command, shown=True)
    except RunError as error:
        raise RunError(f"{error}; a program of a package is started with rosrun PACKAGE {command[0]}") from None


def _wait(simulator: Program, others: list[Program], stop: Stop, path: _Path | None) -> None:
    """Wait until the simulator ends or a stop is requested; RunError if another program ends first."""
    while simulator.exit_code is None and not stop.requested:
        for program in others:
            program.check()
        if path:
            path.advance_start()
        time.sleep(0.05)


class _Path:
    """Plots the robot's path at the end."""

    def __init__(self, scene: str, file: Path) -> None:
        from bubblesim.running.observer import Observer  # a ROS node: it needs a master
        from bubblesim.running.recording import Recording

        self._scene = scene
        self._file = file
        self._recording = Recording()
        self._observer = Observer(self._recording)
        self._start: PausedStart | None = None

    def start_paused(self) -> None:
        """Prepare for a simulation that is paused until its path is observed."""
        from bubblesim.running.paused_start import PausedStart

        self._start = PausedStart(self._observer)

    def advance_start(self) -> None:
        """Let the simulation run as soon as its path is observed."""
        if self._start:
            self._start.advance()

    def draw(self) -> None:
        from bubblesim.running.picture import draw  # matplotlib loads slowly

        self._observer.close()
        if len(self._recording.samples) < 2:
            raise RunError(
                f"{self._file} is not written: no robot was published on /tf and /clock. Has the scene a robot that "
                "publishes its pose, and did the simulation run?"
            )
        draw(self._scene, self._recording, self._file)
        print(f"{self._recording.summary()}\npicture            {self._file}", file=sys.stderr, flush=True)
