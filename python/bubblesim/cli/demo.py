# SPDX-License-Identifier: BSD-3-Clause
"""bubblesim demo: a scene with its controller, progress, and a plot at the end."""

from __future__ import annotations

import argparse
import os
from pathlib import Path
from typing import Any

_DESCRIPTION = """\
Runs a scene with its controller, and starts a roscore if none is running. Prints the address of the window, and shows
the progress. After N seconds or on Ctrl-C, writes demo-SCENE.png to the current folder and prints a summary.

  bubblesim demo                          a tricycle that drives around obstacles
  bubblesim demo bubblerob --seconds 20   another scene, for 20 s"""


def add_parser(commands: Any) -> None:
    """Add the command's arguments."""
    parser: argparse.ArgumentParser = commands.add_parser(
        "demo",
        help="run a scene with its controller, and plot the path",
        description=_DESCRIPTION,
        formatter_class=argparse.RawDescriptionHelpFormatter,
        allow_abbrev=False,
    )
    parser.add_argument(
        "scene", nargs="?", default="tricycle", help="name of a scene or path of a file (default: tricycle)"
    )
    parser.add_argument("--seconds", type=float, default=float("inf"), metavar="N", help="end after N seconds")
    parser.set_defaults(command=_demo, parser=parser)


def _demo(options: argparse.Namespace) -> int:
    from bubblesim.running.demo import run

    os.environ.setdefault("ROS_HOSTNAME", "localhost")  # the machine's host name may not resolve
    run(options.scene, options.seconds, Path.cwd() / f"demo-{Path(options.scene).stem}.png")
    return 0
