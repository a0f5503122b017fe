# SPDX-License-Identifier: BSD-3-Clause
"""bubblesim bridge: pass topics and services between ROS 1 and ROS 2."""

from __future__ import annotations

import argparse
import os
import sys
from typing import Any

from bubblesim.running.places import bridge_program

_DESCRIPTION = """\
Passes topics and services between ROS 1 and ROS 2, both ways, without a simulation, until Ctrl-C. A topic that nobody
receives on the other side costs nothing. Types must be listed in meta/messages.txt or meta/services.txt.

  bubblesim bridge                     all topics and services, as they come and go
  bubblesim bridge /scan /tf /reset    these only
  bubblesim bridge __name:=other       arguments for ROS nodes are accepted"""


def add_parser(commands: Any) -> None:
    """Add the command's arguments."""
    parser: argparse.ArgumentParser = commands.add_parser(
        "bridge",
        help="pass topics and services between ROS 1 and ROS 2",
        description=_DESCRIPTION,
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    parser.add_argument("names", nargs="*", metavar="NAME", help="full name of a topic or service; default: all")
    parser.set_defaults(command=_bridge, parser=parser)


def _bridge(options: argparse.Namespace) -> int:
    program = str(bridge_program())
    os.environ.setdefault("ROS_HOSTNAME", "localhost")  # the machine's host name may not resolve
    sys.stdout.flush()
    os.execv(program, [program, *options.names])
