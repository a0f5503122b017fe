# SPDX-License-Identifier: BSD-3-Clause
"""Paths as messages."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any

import rospy
from geometry_msgs.msg import PoseStamped
from nav_msgs.msg import Path


def path_message(frame: str, points: Iterable[tuple[float, float]]) -> Any:
    """Return a nav_msgs/Path through points of a frame, m, with the present time; its poses have no heading."""
    path = Path()
    path.header.frame_id = frame
    path.header.stamp = rospy.Time.now()
    for x, y in points:
        pose = PoseStamped(header=path.header)
        pose.pose.position.x, pose.pose.position.y, pose.pose.orientation.w = x, y, 1.0
        path.poses.append(pose)
    return path
