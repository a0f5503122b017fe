# SPDX-License-Identifier: BSD-3-Clause
"""bubblesim run: a scene, and what it takes to run it."""

from __future__ import annotations

import argparse
import contextlib
import os
import shlex
import subprocess
import sys
import tempfile
import time
from pathlib import Path
from typing import Any

from bubblesim.running.places import node_program
from bubblesim.running.processes import Program, Programs, RunError
from bubblesim.running.stop import Stop

_DESCRIPTION = """\
Runs a scene in the simulator's node, until Ctrl-C or for the time that --until says. All options of the node are taken,
after the scene's name; they are listed below.

  bubblesim run tricycle                               beside a roscore of yours
  bubblesim run tricycle --roscore --speed 2           with one of its own, twice as fast as real time
  bubblesim run ./mine.sdf --no-ros --until 10         a scene of your own, 10 s, without ROS
  bubblesim run robot.xacro wheels:=4 --roscore        with an argument for xacro
  bubblesim run tricycle --roscore --controller "rosrun bubblesim tricycle_avoid.py" --until 60 --plot path.png"""


def add_parser(commands: Any) -> None:
    """How the command is called."""
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
    parser.add_argument("-h", "--help", action=_Help, nargs=0, help="show this, and the options of the node")
    parser.add_argument("--roscore", action="store_true", help="start a roscore if none answers, on simulated time")
    parser.add_argument("--controller", metavar="COMMAND", type=shlex.split, help="start this beside it, too")
    parser.add_argument(
        "--plot", metavar="FILE", type=Path, help="draw the robot's path, a picture as .png, .pdf, .svg"
    )
    parser.set_defaults(command=_run, parser=parser, other_options=[])


class _Help(argparse.Action):
    """Ours, and then what the node says itself."""

    def __call__(self, parser: argparse.ArgumentParser, *_arguments: object, **_named: object) -> None:
        parser.print_help()
        print("\nThe node's own:\n", flush=True)
        subprocess.run([node_program(), "--help"], check=False)
        parser.exit()


def _run(options: argparse.Namespace) -> int:
    given = options.all_arguments
    if options.other_options and given.index(options.other_options[0]) < given.index(options.scene):
        raise ValueError("the scene comes first: bubblesim run SCENE [option ...]")
    node = [str(node_program()), options.scene, *options.other_options]
    os.environ.setdefault("ROS_HOSTNAME", "localhost")  # a machine's own name need not resolve
    if not (options.roscore or options.controller or options.plot):
        sys.stdout.flush()
        os.execv(node[0], node)
    return _run_with_company(options, node)


def _run_with_company(options: argparse.Namespace, node: list[str]) -> int:
    from bubblesim.running.master import provide_master, require_master, simulated_time

    stop = Stop()
    with contextlib.ExitStack() as stack:
        logs = stack.enter_context(tempfile.TemporaryDirectory(prefix="bubblesim-run-"))
        programs = stack.enter_context(Programs(Path(logs)))
        if not options.roscore:
            require_master()
        elif provide_master(programs, stop):
            if stop.requested:
                return 0
            stack.enter_context(simulated_time())
        path = _Path(options.scene, options.plot) if options.plot else None
        others = list(programs.running)
        simulator = programs.start("simulator", *node, shown=True)
        if options.controller:
            others.append(programs.start("controller", *options.controller, shown=True))
        _wait(simulator, others, stop)
    if path:
        path.draw()
    code = simulator.exit_code or 0
    return max(code, 0) if stop.requested else code  # it may have been too young to know our signal


def _wait(simulator: Program, others: list[Program], stop: Stop) -> None:
    """Until the simulator ends or is to end; RunError when another program ends before."""
    while simulator.exit_code is None and not stop.requested:
        for program in others:
            program.check()
        time.sleep(0.05)


class _Path:
    """The robot's path, drawn at the end."""

    def __init__(self, scene: str, file: Path) -> None:
        from bubblesim.running.observer import Observer  # a ROS node: only once there is a master
        from bubblesim.running.recording import Recording

        self._scene = scene
        self._file = file
        self._recording = Recording()
        self._observer = Observer(self._recording)

    def draw(self) -> None:
        from bubblesim.running.picture import draw  # matplotlib takes its time

        self._observer.close()
        if len(self._recording.samples) < 2:
            raise RunError(f"{self._file} is not drawn: /tf and /clock told of no robot")
        draw(self._scene, self._recording, self._file)
        print(f"{self._recording.summary()}\npicture            {self._file}", file=sys.stderr, flush=True)
