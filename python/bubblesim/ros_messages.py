# SPDX-License-Identifier: BSD-3-Clause
"""ROS messages as dicts for `simROS.publish`, created from states and readings.

Stamps are ROS time in seconds, positions metres, quaternions x, y, z, w.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

from bubblesim.controllers.planar_motion import Pose2D, Velocity
from bubblesim.geometry.rotations import quaternion_of_heading

Message = dict[str, Any]

_FLOAT32 = 7  # sensor_msgs/PointField.FLOAT32
_FIX, _GPS = 0, 1  # sensor_msgs/NavSatStatus.STATUS_FIX, SERVICE_GPS
_DIAGONAL_KNOWN = 2  # sensor_msgs/NavSatFix.COVARIANCE_TYPE_DIAGONAL_KNOWN
_UNKNOWN = 1e6  # variance of unmeasured values: large, because zero would mean certain


def pose_values(message: Message) -> list[float]:
    """Convert a geometry_msgs/Pose to seven numbers."""
    return [*vector_values(message["position"]), *(message["orientation"][axis] for axis in "xyzw")]


def pose_message(pose: Sequence[float]) -> Message:
    """Convert seven numbers to a geometry_msgs/Pose."""
    return {
        "position": vector_message(pose[:3]),
        "orientation": dict(zip("xyzw", pose[3:], strict=True)),
    }


def vector_values(message: Message) -> list[float]:
    """Convert a geometry_msgs/Vector3 or Point to three numbers."""
    return [message[axis] for axis in "xyz"]


def vector_message(vector: Sequence[float]) -> dict[str, float]:
    """Convert three numbers to a geometry_msgs/Vector3 or Point."""
    return dict(zip("xyz", vector, strict=True))


def twist_message(linear: Sequence[float], angular: Sequence[float]) -> Message:
    """Return a geometry_msgs/Twist, from m/s and rad/s."""
    return {"linear": vector_message(linear), "angular": vector_message(angular)}


def header(stamp: float, frame: str) -> Message:
    """Return a std_msgs/Header."""
    return {"stamp": stamp, "frame_id": frame}


def transform(stamp: float, frame: str, child: str, pose: Sequence[float]) -> Message:
    """Return a geometry_msgs/TransformStamped, from [x, y, z, qx, qy, qz, qw]."""
    placed = pose_message(pose)
    return {
        "header": header(stamp, frame),
        "child_frame_id": child,
        "transform": {"translation": placed["position"], "rotation": placed["orientation"]},
    }


def planar_transform(stamp: float, frame: str, child: str, pose: Pose2D) -> Message:
    """Return a geometry_msgs/TransformStamped of a pose in the plane."""
    return transform(stamp, frame, child, [pose.x, pose.y, 0.0, *quaternion_of_heading(pose.heading)])


def planar_odometry(
    stamp: float, frame: str, child: str, pose: Pose2D, velocity: Velocity, variance: float = 1e-3
) -> Message:
    """Return a nav_msgs/Odometry of a pose in the plane.

    :param variance: of x and y in m^2 and of the heading in rad^2, and of their rates.
    """
    return odometry(
        stamp,
        frame,
        child,
        pose=[pose.x, pose.y, 0.0, *quaternion_of_heading(pose.heading)],
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
    """Return a nav_msgs/Odometry, from [x, y, z, qx, qy, qz, qw] in ``frame`` and velocities in the axes of ``child``.

    :param variances: of x, y, z and of the rotations about them, for both pose and velocities.
    """
    covariance = np.diag(variances).ravel()
    return {
        "header": header(stamp, frame),
        "child_frame_id": child,
        "pose": {"pose": pose_message(pose), "covariance": covariance},
        "twist": {
            "twist": twist_message(linear, angular),
            "covariance": covariance,
        },
    }


def joint_state(stamp: float, joints: Mapping[str, tuple[float, float]]) -> Message:
    """Return a sensor_msgs/JointState, from positions and velocities by name; rad and rad/s, or m and m/s."""
    return {
        "header": header(stamp, ""),
        "name": list(joints),
        "position": [position for position, _ in joints.values()],
        "velocity": [velocity for _, velocity in joints.values()],
    }


def point_cloud(stamp: float, frame: str, points: np.ndarray[Any, np.dtype[np.float32]]) -> Message:
    """Return a sensor_msgs/PointCloud2 with the fields x, y, z, from an array of count x 3."""
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


def camera_info(
    stamp: float, frame: str, width: int, height: int, horizontal_fov: float, ros_version: int = 1
) -> Message:
    """Return a sensor_msgs/CameraInfo of a pinhole camera without distortion; pixels and radians.

    ``frame`` is the optical frame: z forward, x to the right (REP 103). ROS 2 writes the names in lower case.
    """
    focal = width / (2.0 * math.tan(horizontal_fov / 2.0))
    # The centre of pixel (0, 0) is half a pixel from the corner.
    x, y = (width - 1) / 2.0, (height - 1) / 2.0
    matrices = {
        "D": [0.0] * 5,
        "K": [focal, 0.0, x, 0.0, focal, y, 0.0, 0.0, 1.0],
        "R": [1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0],
        "P": [focal, 0.0, x, 0.0, 0.0, focal, y, 0.0, 0.0, 0.0, 1.0, 0.0],
    }
    return {
        "header": header(stamp, frame),
        "width": width,
        "height": height,
        "distortion_model": "plumb_bob",
        **{(name.lower() if ros_version == 2 else name): values for name, values in matrices.items()},
    }


def nav_sat_fix(
    stamp: float, frame: str, latitude: float, longitude: float, altitude: float, variances: Sequence[float]
) -> Message:
    """Return a sensor_msgs/NavSatFix; degrees, m above WGS84.

    :param variances: m^2 east, north and up.
    """
    return {
        "header": header(stamp, frame),
        "status": {"status": _FIX, "service": _GPS},
        "latitude": latitude,
        "longitude": longitude,
        "altitude": altitude,
        "position_covariance": np.diag(variances).ravel(),
        "position_covariance_type": _DIAGONAL_KNOWN,
    }
