# SPDX-License-Identifier: BSD-3-Clause
"""ROS messages as the dicts that `simROS.publish` takes, from what robots and their sensors tell.

Stamps are ROS time in seconds, positions metres, quaternions x, y, z, w.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Any

import numpy as np

from bubblesim.controllers.planar_motion import Pose2D, Velocity

Message = dict[str, Any]

_FLOAT32 = 7  # sensor_msgs/PointField.FLOAT32
_UNKNOWN = 1e6  # variance of what is not measured: large, for a zero would mean that it is certain


def header(stamp: float, frame: str) -> Message:
    """std_msgs/Header."""
    return {"stamp": stamp, "frame_id": frame}


def vector(xyz: Sequence[float]) -> Message:
    """geometry_msgs/Vector3 or Point."""
    return dict(zip("xyz", xyz, strict=True))


def quaternion(xyzw: Sequence[float]) -> Message:
    """geometry_msgs/Quaternion."""
    return dict(zip("xyzw", xyzw, strict=True))


def heading(angle: float) -> list[float]:
    """Quaternion of a turn about the vertical."""
    return [0.0, 0.0, math.sin(angle / 2), math.cos(angle / 2)]


def turned_back(rotation: Sequence[float], xyz: Sequence[float]) -> list[float]:
    """A vector in the axes that a quaternion has turned, from one in the world's."""
    qx, qy, qz, qw = rotation
    axis, there = np.array([-qx, -qy, -qz]), np.array(xyz)
    turned = there + 2.0 * np.cross(axis, np.cross(axis, there) + qw * there)
    return [float(number) for number in turned]


def transform(stamp: float, frame: str, child: str, pose: Sequence[float]) -> Message:
    """geometry_msgs/TransformStamped, from [x, y, z, qx, qy, qz, qw]."""
    return {
        "header": header(stamp, frame),
        "child_frame_id": child,
        "transform": {"translation": vector(pose[:3]), "rotation": quaternion(pose[3:])},
    }


def planar_transform(stamp: float, frame: str, child: str, pose: Pose2D) -> Message:
    """geometry_msgs/TransformStamped of what stands on the floor."""
    return transform(stamp, frame, child, [pose.x, pose.y, 0.0, *heading(pose.heading)])


def planar_odometry(
    stamp: float, frame: str, child: str, pose: Pose2D, velocity: Velocity, variance: float = 1e-3
) -> Message:
    """nav_msgs/Odometry of what stands on the floor.

    :param variance: of x and y in m^2 and of the heading in rad^2, and of their rates.
    """
    return odometry(
        stamp,
        frame,
        child,
        pose=[pose.x, pose.y, 0.0, *heading(pose.heading)],
        linear=[velocity.linear, 0.0, 0.0],
        angular=[0.0, 0.0, velocity.angular],
        variances=[variance, variance, _UNKNOWN, _UNKNOWN, _UNKNOWN, variance],
    )


def odometry(
    stamp: float,
    frame: str,
    child: str,
    *,
    pose: Sequence[float],
    linear: Sequence[float],
    angular: Sequence[float],
    variances: Sequence[float] = (0.0,) * 6,
) -> Message:
    """nav_msgs/Odometry, from [x, y, z, qx, qy, qz, qw] in ``frame`` and velocities in the axes of ``child``.

    :param variances: of x, y, z and of the turns about them, for the pose as for the velocities.
    """
    covariance = np.diag(variances).ravel()
    return {
        "header": header(stamp, frame),
        "child_frame_id": child,
        "pose": {
            "pose": {"position": vector(pose[:3]), "orientation": quaternion(pose[3:])},
            "covariance": covariance,
        },
        "twist": {"twist": {"linear": vector(linear), "angular": vector(angular)}, "covariance": covariance},
    }


def joint_state(stamp: float, names: Sequence[str], positions: Sequence[float], velocities: Sequence[float]) -> Message:
    """sensor_msgs/JointState; rad and rad/s, or m and m/s."""
    return {
        "header": header(stamp, ""),
        "name": list(names),
        "position": list(positions),
        "velocity": list(velocities),
    }


def point_cloud(stamp: float, frame: str, points: np.ndarray[Any, np.dtype[np.float32]]) -> Message:
    """sensor_msgs/PointCloud2 of the fields x, y, z, from an array of count x 3."""
    size = points.itemsize
    return {
        "header": header(stamp, frame),
        "height": 1,
        "width": len(points),
        "fields": [
            {"name": name, "offset": i * size, "datatype": _FLOAT32, "count": 1} for i, name in enumerate("xyz")
        ],
        "is_bigendian": False,
        "point_step": 3 * size,
        "row_step": points.nbytes,
        "data": points.tobytes(),
        "is_dense": True,
    }
