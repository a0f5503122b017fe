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
  bubblesim demo bubblerob --seconds 20   another scene, for 20 s
  bubblesim demo --no-ros                 the tricycle in this process, as fast as it can"""


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
    parser.add_argument("--seconds", type=float, metavar="N", help="end after N seconds")
    parser.add_argument(
        "--no-ros",
        action="store_true",
        help="the tricycle without ROS and a window, at full speed; N is simulated time (default: 60)",
    )
    parser.set_defaults(command=_demo, parser=parser)


def _demo(options: argparse.Namespace) -> int:
    picture = Path.cwd() / f"demo-{Path(options.scene).stem}.png"
    if options.no_ros:
        from bubblesim.running import demo_without_ros

        if options.scene != demo_without_ros.SCENE:
            raise ValueError(
                f"--no-ros is for {demo_without_ros.SCENE}; for others: bubblesim run {options.scene} --no-ros"
            )
        demo_without_ros.run(60.0 if options.seconds is None else options.seconds, picture)
        return 0
    from bubblesim.running.demo import run

    os.environ.setdefault("ROS_HOSTNAME", "localhost")  # the machine's host name may not resolve
    run(options.scene, float("inf") if options.seconds is None else options.seconds, picture)
    return 0
