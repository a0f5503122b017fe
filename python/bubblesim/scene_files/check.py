# SPDX-License-Identifier: BSD-3-Clause
"""Validate scenes and models: report all problems of a file at once."""

from __future__ import annotations

import argparse
import sys
from collections.abc import Mapping, Sequence

import bubblesim
from bubblesim.gazebo_plugins.checked_plugins import CheckedPlugins
from bubblesim.scene_files.sensor_frames import report_sensor_frames
from bubblesim.scene_files.unit_questions import report_unit_questions

DESCRIPTION = """\
Loads scenes and models (SDFormat, URDF, xacro), runs each for one second of simulated time and prints all problems
as FILE:LINE: OBJECT: PROBLEM."""
EPILOG = "exit codes: 0 no problems, also with warnings, 2 problems found"

_SECONDS = 1.0  # simulated time for which each scene is run


def problems_of(scene: str, arguments: Mapping[str, str] | None = None) -> list[str]:
    """Return the problems of a scene or model, given by path or name: one line each, with file:line and object.

    A .xacro file is expanded with the ``arguments``. Warnings about ignored elements are written to stderr.
    """
    return _findings(scene, arguments or {})[0]


def _findings(scene: str, arguments: Mapping[str, str]) -> tuple[list[str], int]:
    """Return the problems of a scene, and the number of warnings that were written."""
    try:
        simulation = bubblesim.Simulation(scene, arguments=dict(arguments))
        plugins = CheckedPlugins(bubblesim.Simulation(simulation.scene))  # another one: they command joints
        warnings = len(simulation.scene.warnings) + plugins.warnings
        warnings += report_unit_questions(simulation) + report_sensor_frames(simulation)
        models = len(simulation.world.models)
        simulation.step(max(1, round(_SECONDS / simulation.time_step)))
    except bubblesim.SceneError as error:
        return str(error).splitlines(), 0
    except (bubblesim.Diverged, ValueError) as error:
        return [f"{scene}: {error}"], 0
    fallen = models - len(simulation.world.models)
    return plugins.problems, warnings + fallen


def _summary(warnings: int) -> str:
    if warnings == 0:
        return "fine"
    return f"{warnings} warning{'s' if warnings > 1 else ''}"


def check(scenes: Sequence[str]) -> int:
    """Print the problems of each scene, or how many warnings it has; return the exit code: 2 if there are problems,
    else 0.

    Items of the form NAME:=VALUE are arguments of the .xacro files.
    """
    arguments = dict(scene.split(":=", 1) for scene in scenes if ":=" in scene)
    scenes = [scene for scene in scenes if ":=" not in scene]
    if arguments and not any(scene.endswith(".xacro") for scene in scenes):
        raise ValueError(f"{next(iter(arguments))}:= is an argument of .xacro files, but no .xacro file is given")
    code = 0
    for scene in scenes:
        problems, warnings = _findings(scene, arguments)
        for line in problems or [f"{scene}: {_summary(warnings)}"]:
            print(line, flush=True)
        if problems:
            code = 2
    return code


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the arguments of the command."""
    parser.add_argument(
        "scenes",
        nargs="+",
        metavar="FILE",
        help="an SDFormat, URDF or .xacro file, or the name of a scene; NAME:=VALUE is an argument of .xacro files",
    )


def main(arguments: Sequence[str] | None = None) -> int:
    """Run the program check; return the exit code."""
    parser = argparse.ArgumentParser(prog="check", description=DESCRIPTION, epilog=EPILOG)
    add_arguments(parser)
    try:
        return check(parser.parse_args(arguments).scenes)
    except ValueError as error:
        parser.error(str(error))


if __name__ == "__main__":
    sys.exit(main())
