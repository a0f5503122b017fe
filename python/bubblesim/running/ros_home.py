# SPDX-License-Identifier: BSD-3-Clause
"""The folder of ROS's logs where the home cannot be written, as on a live system or a cluster."""

from __future__ import annotations

import os
import sys
from pathlib import Path


def use_writable_ros_home(instead: Path) -> None:
    """Let ROS write to a folder instead of ~/.ros if it cannot write there; print this.

    roscore ends otherwise, and so does each node.
    """
    if os.environ.get("ROS_HOME"):
        return
    home = Path.home() / ".ros"
    try:
        home.mkdir(exist_ok=True)
        why = "" if os.access(home, os.W_OK | os.X_OK) else "permission denied"
    except OSError as error:
        why = error.strerror or str(error)
    if why:
        os.environ["ROS_HOME"] = str(instead)
        print(f"info: {home} cannot be written ({why}): ROS keeps its files in {instead}", file=sys.stderr, flush=True)
