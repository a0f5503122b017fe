# SPDX-License-Identifier: BSD-3-Clause
"""bubblesim convert: write a scene or model of CoppeliaSim as SDFormat."""

from __future__ import annotations

import argparse
import sys
from pathlib import Path
from typing import Any

from bubblesim.running.foreign_scenes import read_foreign

_DESCRIPTION = """\
Writes a file of CoppeliaSim (.ttt, .ttm) as a scene in SDFormat: FOLDER/scene.sdf, with its meshes, textures and child
scripts in folders beside it. Prints what does not come over; left_out.txt in FOLDER has it, too."""


def add_parser(commands: Any) -> None:
    """Add the command's arguments."""
    parser: argparse.ArgumentParser = commands.add_parser(
        "convert", help="write a file of CoppeliaSim as SDFormat", description=_DESCRIPTION, allow_abbrev=False
    )
    parser.add_argument("file", metavar="FILE", type=Path, help="a .ttt or .ttm file")
    parser.add_argument("folder", metavar="FOLDER", type=Path, help="a folder that is new or empty")
    parser.set_defaults(command=_convert, parser=parser)


def _convert(options: argparse.Namespace) -> int:
    folder: Path = options.folder
    if folder.exists() and (not folder.is_dir() or any(folder.iterdir())):
        raise ValueError(f"{folder} is not an empty folder: give a new one")
    try:
        folder.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise ValueError(f"{folder} cannot be made: {error.strerror}") from error
    if left_out := read_foreign("convert", options.file, folder).splitlines():
        print("left out or changed:", *left_out, sep="\n  ", file=sys.stderr)
    print(folder / "scene.sdf")
    return 0
