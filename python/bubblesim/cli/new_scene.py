# SPDX-License-Identifier: BSD-3-Clause
"""bubblesim new-scene: create a scene and its script from templates."""

from __future__ import annotations

import argparse
import re
import sys
from pathlib import Path
from typing import Any

_TEMPLATES = Path(__file__).with_name("templates")
_NAME = re.compile(r"[A-Za-z]\w*")
_KINDS = {
    "robot": "a robot with two driven wheels, a lidar and a sonar, and a script that drives it",
    "arm": "an arm with three joints, and a script that moves it",
    "drone": "a quadcopter, and a script that flies it",
    "empty": "a floor in daylight",
}


def add_parser(commands: Any) -> None:
    """Add the command's arguments."""
    parser: argparse.ArgumentParser = commands.add_parser(
        "new-scene",
        help="create a new scene",
        description="Writes NAME.sdf and, but for an empty scene, NAME.py, its child script. Both run without changes. "
        "On a terminal it asks for the template.",
        epilog="example: bubblesim new-scene mine && bubblesim run ./mine.sdf --no-ros --until 5",
    )
    parser.add_argument("name", metavar="NAME", help="letters, digits and underscores")
    parser.add_argument(
        "--template", choices=_KINDS, help="; ".join(f"{kind}: {what}" for kind, what in _KINDS.items())
    )
    parser.add_argument("--folder", type=Path, default=Path(), metavar="DIR", help="output folder (default: current)")
    parser.set_defaults(command=_make, parser=parser)


def _make(options: argparse.Namespace) -> int:
    name: str = options.name
    if not _NAME.fullmatch(name):
        folder = "; its folder is given by --folder" if "/" in name else ""
        raise ValueError(
            f"'{name}' is not a valid scene name: use a letter, then letters, digits and underscores{folder}"
        )
    kind = options.template or _asked()
    templates = {suffix: _TEMPLATES / f"{kind}{suffix}.in" for suffix in (".sdf", ".py")}
    files = {options.folder / f"{name}{suffix}": file for suffix, file in templates.items() if file.exists()}
    for file in files:
        if file.exists():
            raise ValueError(f"{file} already exists: choose another name, or another folder with --folder")
    for file, template in files.items():
        try:
            file.write_text(template.read_text().replace("NAME", name))
        except OSError as error:
            raise ValueError(f"cannot write {file}: {error.strerror}") from None
        print(file)
    scene = options.folder / f"{name}.sdf"
    print(f"try it: bubblesim run {scene if scene.parent.parts else f'./{scene}'} --roscore", file=sys.stderr)
    return 0


def _asked() -> str:
    """Return the template that the user wants; without a terminal the first one."""
    kinds = list(_KINDS)
    if not (sys.stdin.isatty() and sys.stderr.isatty()):
        return kinds[0]
    for number, kind in enumerate(kinds, 1):
        print(f"{number} {kind:6} {_KINDS[kind]}", file=sys.stderr)
    while True:
        print("template [1]: ", end="", file=sys.stderr, flush=True)
        answer = sys.stdin.readline().strip().lower() or kinds[0]
        if answer in kinds:
            return answer
        if answer.isdigit() and 0 < int(answer) <= len(kinds):
            return kinds[int(answer) - 1]
