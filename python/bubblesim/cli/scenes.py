# SPDX-License-Identifier: BSD-3-Clause
"""bubblesim scenes: list the scenes."""

from __future__ import annotations

import argparse
import re
from pathlib import Path
from typing import Any

from bubblesim._core import scene_folders, scene_names

_COMMENT = re.compile(r"<!--(.*?)-->", re.DOTALL)


def add_parser(commands: Any) -> None:
    """Add the command's arguments."""
    parser: argparse.ArgumentParser = commands.add_parser(
        "scenes",
        help="list the scenes",
        description="Lists the scenes: the name for `bubblesim run` and a description.",
        epilog="Additional folders, searched first: BUBBLESIM_SCENE_PATH=FOLDER:FOLDER",
    )
    parser.set_defaults(command=_list_scenes, parser=parser)


def _list_scenes(options: argparse.Namespace) -> int:
    names = scene_names()
    width = max(map(len, names), default=0)
    for name in names:
        print(f"{name:{width}}  {summary(_file(name))}".rstrip())
    return 0


def _file(name: str) -> Path:
    return next(file for folder in scene_folders() if (file := Path(folder) / f"{name}.sdf").is_file())


def summary(file: Path) -> str:
    """Return the first sentence of the first comment in a scene's file, except the licence."""
    comments = (" ".join(text.split()) for text in _COMMENT.findall(file.read_text(errors="replace")))
    sentences = next((text for text in comments if not text.startswith("SPDX")), "")
    return re.split(r"(?<=\.)\s", sentences, maxsplit=1)[0].removesuffix(".")
