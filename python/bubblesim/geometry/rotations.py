# SPDX-License-Identifier: BSD-3-Clause
"""Unit quaternions (x, y, z, w), rotation matrices, Euler angles and headings; angles in radians."""

from __future__ import annotations

import math
from collections.abc import Sequence


def matrix(quaternion: Sequence[float]) -> list[list[float]]:
    """Return the 3x3 rotation matrix of a unit quaternion."""
    x, y, z, w = quaternion
    return [
        [1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
        [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
        [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)],
    ]


def matrix_of_pose(pose: Sequence[float]) -> list[float]:
    """Return the upper three rows of the 4x4 matrix of [x, y, z, qx, qy, qz, qw], row by row."""
    return [number for row, offset in zip(matrix(pose[3:]), pose[:3], strict=True) for number in (*row, offset)]


def euler_angles(quaternion: Sequence[float]) -> list[float]:
    """Return [alpha, beta, gamma] with R = Rx(alpha) Ry(beta) Rz(gamma); alpha is 0 in gimbal lock."""
    r = matrix(quaternion)
    beta = math.asin(max(-1.0, min(1.0, r[0][2])))
    if abs(r[0][2]) > 1 - 1e-12:
        return [0.0, beta, math.atan2(r[1][0], r[1][1])]
    return [math.atan2(-r[1][2], r[2][2]), beta, math.atan2(-r[0][1], r[0][0])]


def quaternion_of_euler(angles: Sequence[float]) -> list[float]:
    """Compute the inverse of :func:`euler_angles`."""
    alpha, beta, gamma = (angle / 2 for angle in angles)
    about_x = [math.sin(alpha), 0.0, 0.0, math.cos(alpha)]
    about_y = [0.0, math.sin(beta), 0.0, math.cos(beta)]
    about_z = [0.0, 0.0, math.sin(gamma), math.cos(gamma)]
    return product(product(about_x, about_y), about_z)


def quaternion_of_rpy(angles: Sequence[float]) -> list[float]:
    """Return the quaternion of roll, pitch and yaw as in URDF and SDFormat: Rz(yaw) Ry(pitch) Rx(roll)."""
    roll, pitch, yaw = (angle / 2 for angle in angles)
    about_x = [math.sin(roll), 0.0, 0.0, math.cos(roll)]
    about_y = [0.0, math.sin(pitch), 0.0, math.cos(pitch)]
    about_z = [0.0, 0.0, math.sin(yaw), math.cos(yaw)]
    return product(about_z, product(about_y, about_x))


def product(a: Sequence[float], b: Sequence[float]) -> list[float]:
    """Return the rotation b followed by a."""
    ax, ay, az, aw = a
    bx, by, bz, bw = b
    return [
        aw * bx + ax * bw + ay * bz - az * by,
        aw * by - ax * bz + ay * bw + az * bx,
        aw * bz + ax * by - ay * bx + az * bw,
        aw * bw - ax * bx - ay * by - az * bz,
    ]


def heading_of(x: float, y: float, z: float, w: float) -> float:
    """Return the rotation about the vertical axis, rad, of a unit quaternion: the yaw of its roll, pitch and yaw."""
    return math.atan2(2.0 * (w * z + x * y), 1.0 - 2.0 * (y * y + z * z))


def quaternion_of_heading(heading: float) -> list[float]:
    """Return [x, y, z, w] of a rotation about the vertical axis by this angle, rad."""
    return [0.0, 0.0, math.sin(heading / 2), math.cos(heading / 2)]
