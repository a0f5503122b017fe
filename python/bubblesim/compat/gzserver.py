# SPDX-License-Identifier: BSD-3-Clause
"""The programs gzserver and gazebo: the node sim, started with Gazebo's arguments."""

from __future__ import annotations

import argparse
import os
import shlex
import sys
from collections.abc import Sequence
from pathlib import Path

import rospkg

from bubblesim.running.places import node_program
from bubblesim.running.processes import RunError

OPTIONS = "BUBBLESIM_GAZEBO_OPTIONS"  # variable of the environment: further arguments of sim

_DESCRIPTION = f"""\
Starts bubblesim's node sim as the node gazebo. Arguments that are not listed are those of sim, such as --speed 5; the
environment variable {OPTIONS} may have more of them, for launch files that pass none."""


def main(arguments: Sequence[str], *, window: bool) -> int:
    """Replace this process by the node; return the exit code for bad arguments.

    :param window: whether to show the window too, as the program gazebo does.
    """
    try:
        command = node_command(arguments, shlex.split(os.environ.get(OPTIONS, "")), window=window)
    except (FileNotFoundError, RunError) as error:
        print(f"error: {error}", file=sys.stderr)
        return 2
    os.execv(command[0], command)


def node_command(arguments: Sequence[str], options: Sequence[str], *, window: bool) -> list[str]:
    """Return the command of the node.

    :param options: further arguments of sim.
    :raises FileNotFoundError: if there is no such world.
    """
    parser = _parser()
    given, others = parser.parse_known_args(arguments)
    words = [word for word in others if not word.startswith("-") and ":=" not in word]
    world = next((word for word in words if _is_world(word)), None)
    if world is not None:
        others.remove(world)
    if given.ignored:
        print(f"warning: not supported, and ignored: {', '.join(sorted(set(given.ignored)))}", file=sys.stderr)
    command = [str(node_program()), str(find_world(world or "worlds/empty.world")), "--gazebo-compat"]
    if given.pause:
        command.append("--paused")
    if given.seed is not None:
        command += ["--seed", given.seed]
    if window and "--web" not in others:
        others.append("--web")
    remappings = [word for word in others if ":=" in word]
    if not any(word.startswith("__name:=") for word in remappings):
        remappings.append("__name:=gazebo")
    return [*command, *(word for word in others if ":=" not in word), *options, *remappings]


def find_world(name: str) -> Path:
    """Return the file of a world: a path, or a name below GAZEBO_RESOURCE_PATH or in our package gazebo_ros.

    :raises FileNotFoundError: with the folders that were searched.
    """
    folders = [Path(), *map(Path, filter(None, os.environ.get("GAZEBO_RESOURCE_PATH", "").split(":"))), *_own_folder()]
    for folder in folders:
        if (folder / name).is_file():
            return (folder / name).absolute()
    searched = ", ".join(str(folder.absolute()) for folder in folders)
    raise FileNotFoundError(f"world {name} not found in: {searched}; GAZEBO_RESOURCE_PATH may name more folders")


def _own_folder() -> list[Path]:
    """Return the folder of the package gazebo_ros."""
    try:
        return [Path(rospkg.RosPack().get_path("gazebo_ros"))]
    except rospkg.ResourceNotFound:
        return []


def _is_world(word: str) -> bool:
    return "/" in word or word.endswith((".world", ".sdf"))


class _Ignored(argparse.Action):
    def __call__(
        self, parser: object, namespace: argparse.Namespace, values: object, option: str | None = None
    ) -> None:
        namespace.ignored = [*namespace.ignored, option]


def _parser() -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser(
        prog="gzserver", usage="%(prog)s [options] [WORLD]", description=_DESCRIPTION, allow_abbrev=False
    )
    parser.set_defaults(ignored=[])
    parser.add_argument("-u", "--pause", action="store_true", help="start paused")
    parser.add_argument("--seed", help="random seed")
    parser.add_argument("-e", "--physics", help="accepted; the physics is ODE")
    parser.add_argument("--verbose", action="store_true", help="accepted; all messages are written anyway")
    parser.add_argument("--minimal_comms", action="store_true", help="accepted")
    for names in (
        ["-s", "--server-plugin"],
        ["-g", "--gui-plugin"],
        ["-o", "--profile"],
        ["--iters"],
        ["-p", "--play"],
    ):
        parser.add_argument(*names, action=_Ignored, help="ignored with a warning")
    for names in (["-r", "--record"], ["--lockstep-physics"]):
        parser.add_argument(*names, action=_Ignored, nargs=0, help="ignored with a warning")
    for name in ("path", "period", "filter", "encoding"):
        parser.add_argument(f"--record_{name}", action=_Ignored, help="ignored with a warning")
    return parser
