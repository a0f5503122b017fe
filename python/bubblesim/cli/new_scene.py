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


def add_parser(commands: Any) -> None:
    """Add the command's arguments."""
    parser: argparse.ArgumentParser = commands.add_parser(
        "new-scene",
        help="create a new scene",
        description="Writes NAME.sdf, a robot with two driven wheels and a sonar, and NAME.py, the child script that "
        "drives it. Both run without changes.",
        epilog="example: bubblesim new-scene mine && bubblesim run ./mine.sdf --no-ros --until 5",
    )
    parser.add_argument("name", metavar="NAME", help="letters, digits and underscores")
    parser.add_argument("--folder", type=Path, default=Path(), metavar="DIR", help="output folder (default: current)")
    parser.set_defaults(command=_make, parser=parser)


def _make(options: argparse.Namespace) -> int:
    name: str = options.name
    if not _NAME.fullmatch(name):
        raise ValueError(f"'{name}' is not a valid scene name: use a letter, then letters, digits and underscores")
    files = {options.folder / f"{name}{kind}": _TEMPLATES / f"scene{kind}.in" for kind in (".sdf", ".py")}
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
