# SPDX-License-Identifier: BSD-3-Clause
"""Products of poses [x, y, z, qx, qy, qz, qw] and of matrices: the upper three rows of a 4x4 matrix, 12 numbers."""

from __future__ import annotations

import math
from collections.abc import Sequence

from bubblesim.geometry import rotations

Pose = list[float]
IDENTITY = [0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0]


def multiply(a: Sequence[float], b: Sequence[float]) -> Pose:
    """Return the pose b, given in the frame a, in the frame of a."""
    return [*transform(a, b[:3]), *rotations.product(a[3:], b[3:])]


def inverse(pose: Sequence[float]) -> Pose:
    """Return the inverse of a pose."""
    back = [-pose[3], -pose[4], -pose[5], pose[6]]
    return [*_rotate(back, [-number for number in pose[:3]]), *back]


def transform(pose: Sequence[float], point: Sequence[float]) -> list[float]:
    """Return a point of the frame ``pose`` in the frame of ``pose``."""
    return [x + y for x, y in zip(pose[:3], _rotate(pose[3:], point), strict=True)]


def interpolate(a: Sequence[float], b: Sequence[float], factor: float) -> Pose:
    """Return a pose between two: the position on a line, the orientation on the shortest arc (slerp)."""
    position = [x + factor * (y - x) for x, y in zip(a[:3], b[:3], strict=True)]
    cosine = sum(x * y for x, y in zip(a[3:], b[3:], strict=True))
    end = list(b[3:]) if cosine >= 0 else [-number for number in b[3:]]
    angle = math.acos(min(1.0, abs(cosine)))
    if angle < 1e-9:
        return [*position, *a[3:]]
    near, far = (math.sin(part * angle) / math.sin(angle) for part in (1 - factor, factor))
    return [*position, *(near * x + far * y for x, y in zip(a[3:], end, strict=True))]


def of_matrix(matrix: Sequence[float]) -> Pose:
    """Return the pose of a matrix; its rotation must be orthonormal (Shepperd's method)."""
    (a, b, c), (d, e, f), (g, h, i) = matrix[0:3], matrix[4:7], matrix[8:11]
    position = [matrix[3], matrix[7], matrix[11]]
    largest = max(a, e, i, a + e + i)
    if largest == a + e + i:
        quaternion = [h - f, c - g, d - b, 1 + a + e + i]
    elif largest == a:
        quaternion = [1 + a - e - i, b + d, c + g, h - f]
    elif largest == e:
        quaternion = [b + d, 1 - a + e - i, f + h, c - g]
    else:
        quaternion = [c + g, f + h, 1 - a - e + i, d - b]
    length = math.hypot(*quaternion)
    return [*position, *(number / length for number in quaternion)]


def about_axis(axis: Sequence[float], angle: float) -> list[float]:
    """Return the quaternion of a rotation by an angle, rad, about an axis of any length but 0."""
    length = math.hypot(*axis)
    if length == 0:
        raise ValueError("the axis of a rotation must not be 0")
    return [*(number / length * math.sin(angle / 2) for number in axis), math.cos(angle / 2)]


def axis_angle(quaternion: Sequence[float]) -> tuple[list[float], float]:
    """Return the axis and the angle, 0 to pi rad, of a rotation; the x axis if there is none."""
    x, y, z, w = quaternion if quaternion[3] >= 0 else [-number for number in quaternion]
    length = math.hypot(x, y, z)
    if length < 1e-12:
        return [1.0, 0.0, 0.0], 0.0
    return [x / length, y / length, z / length], 2 * math.atan2(length, w)


def _rotate(quaternion: Sequence[float], vector: Sequence[float]) -> list[float]:
    return [sum(x * y for x, y in zip(row, vector, strict=True)) for row in rotations.matrix(quaternion)]
