# SPDX-License-Identifier: BSD-3-Clause
"""bubblesim check: validate scenes and models."""

from __future__ import annotations

import argparse
from typing import Any

from bubblesim import checking


def add_parser(commands: Any) -> None:
    """Add the command's arguments."""
    parser: argparse.ArgumentParser = commands.add_parser(
        "check",
        help="validate scenes and models",
        description=checking.DESCRIPTION,
        epilog=checking.EPILOG,
    )
    checking.add_arguments(parser)
    parser.set_defaults(command=_check, parser=parser)


def _check(options: argparse.Namespace) -> int:
    return checking.check(options.scenes)
