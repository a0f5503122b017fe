# SPDX-License-Identifier: BSD-3-Clause
"""bubblesim describe: show what is in a scene or model of CoppeliaSim, without running anything."""

from __future__ import annotations

import argparse
import sys
from pathlib import Path
from typing import Any

from bubblesim.running.foreign_scenes import read_foreign

_DESCRIPTION = """\
Prints the objects of a file of CoppeliaSim (.ttt, .ttm), its scripts, and what will be left out or changed when it is
run. Nothing is run."""


def add_parser(commands: Any) -> None:
    """Add the command's arguments."""
    parser: argparse.ArgumentParser = commands.add_parser(
        "describe", help="show what is in a file of CoppeliaSim", description=_DESCRIPTION, allow_abbrev=False
    )
    parser.add_argument("file", metavar="FILE", type=Path, help="a .ttt or .ttm file")
    parser.set_defaults(command=_describe, parser=parser)


def _describe(options: argparse.Namespace) -> int:
    sys.stdout.write(read_foreign("describe", options.file))
    return 0
