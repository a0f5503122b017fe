# SPDX-License-Identifier: BSD-3-Clause
"""bubblesim compat: list the packages with the names that launch files ask for."""

from __future__ import annotations

import argparse
from typing import Any


def add_parser(commands: Any) -> None:
    """Add the command's arguments."""
    parser: argparse.ArgumentParser = commands.add_parser(
        "compat",
        help="list the packages that stand in for those of Gazebo",
        description="Lists the ROS packages of bubblesim that have the names of packages which Debian lacks, and that "
        "launch files of robots ask for. A package of that name in your workspace comes first.",
    )
    parser.set_defaults(command=_list_packages, parser=parser)


def _list_packages(options: argparse.Namespace) -> int:
    from bubblesim.compat.packages import PACKAGES, folder_of, is_ours

    width = max(map(len, PACKAGES))
    for name, contents in PACKAGES.items():
        folder = folder_of(name)
        if folder is None:
            contents = "not found: build bubblesim, and source the workspace's setup.bash"
        elif not is_ours(folder):
            contents = f"yours: {folder}"
        print(f"{name:{width}}  {contents}")
    return 0
