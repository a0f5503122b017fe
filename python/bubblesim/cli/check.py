# SPDX-License-Identifier: BSD-3-Clause
"""bubblesim check: validate scenes and models."""

from __future__ import annotations

import argparse
from typing import Any

from bubblesim.scene_files import check as scene_check


def add_parser(commands: Any) -> None:
    """Add the command's arguments."""
    parser: argparse.ArgumentParser = commands.add_parser(
        "check",
        help="validate scenes and models",
        description=scene_check.DESCRIPTION,
        epilog=scene_check.EPILOG,
    )
    scene_check.add_arguments(parser)
    parser.set_defaults(command=_check, parser=parser)


def _check(options: argparse.Namespace) -> int:
    return scene_check.check(options.scenes)
