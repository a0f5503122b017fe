# SPDX-License-Identifier: BSD-3-Clause
"""The folder of ROS's files where the home cannot be written, as on a live system or a cluster."""

from __future__ import annotations

import os
from pathlib import Path

from bubblesim import _core


def use_writable_ros_home() -> None:
    """Let ROS write to a temporary folder, one for each user, if it cannot write to ~/.ros; print this.

    roscore ends otherwise, and so does each node.
    """
    if folder := _core.use_writable_ros_home():
        os.environ["ROS_HOME"] = folder


def ros_home() -> Path:
    """Return the folder of ROS's files, which can be written if any can."""
    use_writable_ros_home()
    return Path(os.environ.get("ROS_HOME") or Path.home() / ".ros")
