# SPDX-License-Identifier: BSD-3-Clause
"""Whether scenes and models can be used: what is wrong with a file, all at once."""

from __future__ import annotations

import argparse
import sys
from collections.abc import Mapping, Sequence

import bubblesim
from bubblesim.gazebo_plugins.unknown_plugins import report_unknown_plugins

DESCRIPTION = """\
Loads scenes and models (SDFormat, URDF, xacro), runs each for a second of simulated time and prints all that is wrong,
as FILE:LINE: OBJECT: PROBLEM."""
EPILOG = "exit codes: 0 all are fine, 2 there is a problem"

_SECONDS = 1.0  # of simulated time in which a scene has to hold


def problems_of(scene: str, arguments: Mapping[str, str] | None = None) -> list[str]:
    """All that is wrong with a scene or model, by path or name: a line each, with file:line and object where known.

    A .xacro file is expanded with the ``arguments``. What is left out is written to stderr.
    """
    try:
        simulation = bubblesim.Simulation(scene, arguments=dict(arguments or {}))
        report_unknown_plugins(simulation)
        simulation.step(max(1, round(_SECONDS / simulation.time_step)))
    except bubblesim.SceneError as error:
        return str(error).splitlines()
    except (bubblesim.Diverged, ValueError) as error:
        return [f"{scene}: {error}"]
    return []


def check(scenes: Sequence[str]) -> int:
    """Print what is wrong with each scene, or that it is fine; the exit code: 2 when there is a problem, else 0.

    NAME:=VALUE among them is an argument of the .xacro files.
    """
    arguments = dict(scene.split(":=", 1) for scene in scenes if ":=" in scene)
    scenes = [scene for scene in scenes if ":=" not in scene]
    if arguments and not any(scene.endswith(".xacro") for scene in scenes):
        raise ValueError(f"{next(iter(arguments))}:= is an argument of .xacro files, and none is given")
    code = 0
    for scene in scenes:
        problems = problems_of(scene, arguments)
        for line in problems or [f"{scene}: fine"]:
            print(line, flush=True)
        if problems:
            code = 2
    return code


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """What the program takes."""
    parser.add_argument(
        "scenes",
        nargs="+",
        metavar="FILE",
        help="a file, or the name of a scene; NAME:=VALUE is an argument of .xacro files",
    )


def main(arguments: Sequence[str] | None = None) -> int:
    """Run the program check; returns the exit code."""
    parser = argparse.ArgumentParser(prog="check", description=DESCRIPTION, epilog=EPILOG)
    add_arguments(parser)
    try:
        return check(parser.parse_args(arguments).scenes)
    except ValueError as error:
        parser.error(str(error))


if __name__ == "__main__":
    sys.exit(main())
