# SPDX-License-Identifier: BSD-3-Clause
"""bubblesim scenes: the scenes that are there."""

from __future__ import annotations

import argparse
import re
from pathlib import Path
from typing import Any

from bubblesim._core import scene_folders, scene_names

_COMMENT = re.compile(r"<!--(.*?)-->", re.DOTALL)


def add_parser(commands: Any) -> None:
    """How the command is called."""
    parser: argparse.ArgumentParser = commands.add_parser(
        "scenes",
        help="list the scenes",
        description="Lists the scenes: a name that `bubblesim run` takes, and what it is.",
        epilog="Folders of your own are searched first: BUBBLESIM_SCENE_PATH=FOLDER:FOLDER",
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
    """What a scene's file says about it: the first sentence of its first comment, but for the licence."""
    comments = (" ".join(text.split()) for text in _COMMENT.findall(file.read_text(errors="replace")))
    said = next((text for text in comments if not text.startswith("SPDX")), "")
    return re.split(r"(?<=\.)\s", said, maxsplit=1)[0].removesuffix(".")
