# SPDX-License-Identifier: BSD-3-Clause
"""Points and poses in the plane, and their conversion from ROS messages: transforms and scans."""

import math
from typing import Any

import numpy as np

from bubblesim.controllers.planar_motion import Pose2D
from bubblesim.geometry import rotations

Point = tuple[float, float]
"""m"""


def seen_from(pose: Pose2D, point: Point) -> Point:
    """Transform a point into the robot's frame: forward, left."""
    dx, dy = point[0] - pose.x, point[1] - pose.y
    cosine, sine = math.cos(pose.heading), math.sin(pose.heading)
    return cosine * dx + sine * dy, cosine * dy - sine * dx


def placed(pose: Pose2D, seen: Point) -> Point:
    """Transform a point from the robot's frame: the inverse of seen_from."""
    cosine, sine = math.cos(pose.heading), math.sin(pose.heading)
    return pose.x + cosine * seen[0] - sine * seen[1], pose.y + sine * seen[0] + cosine * seen[1]


def heading_of(rotation: Any) -> float:
    """Return the rotation about z, rad, of a geometry_msgs/Quaternion."""
    return rotations.heading_of(rotation.x, rotation.y, rotation.z, rotation.w)


def pose_of(transform: Any) -> Pose2D:
    """Return the planar part of a geometry_msgs/Transform."""
    return Pose2D(transform.translation.x, transform.translation.y, heading_of(transform.rotation))


def hits(scan: Any, lidar: Pose2D) -> list[Point]:
    """Return the points hit in a sensor_msgs/LaserScan; ``lidar`` is the lidar's pose in the target frame."""
    ranges = np.asarray(scan.ranges)
    angles = scan.angle_min + scan.angle_increment * np.arange(len(ranges)) + lidar.heading
    met = np.isfinite(ranges) & (ranges >= scan.range_min) & (ranges <= scan.range_max)
    xs = lidar.x + ranges[met] * np.cos(angles[met])
    ys = lidar.y + ranges[met] * np.sin(angles[met])
    return list(zip(xs.tolist(), ys.tolist(), strict=True))
