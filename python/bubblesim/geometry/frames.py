# SPDX-License-Identifier: BSD-3-Clause
"""Poses and velocities relative to an object. Poses are [x, y, z, qx, qy, qz, qw]; SI units."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from bubblesim.geometry.rotations import matrix

Vector = list[float]


def state_in(world: Any, handle: int, reference: int | None) -> tuple[list[float], Vector, Vector]:
    """Return pose, linear and angular velocity of an object's origin relative to `reference`, None for the world.

    For a moving reference: p' = R^T (v - v_ref - w_ref x (p - p_ref)), w' = R^T (w - w_ref).
    """
    pose: list[float] = world.pose(handle)
    linear, angular = world.velocity(handle)
    if reference is None:
        return pose, linear, angular
    frame = world.pose(reference)
    frame_linear, frame_angular = world.velocity(reference)
    carried = _cross(frame_angular, _difference(pose[:3], frame[:3]))
    relative = _difference(_difference(linear, frame_linear), carried)
    turning = _difference(angular, frame_angular)
    return world.pose_in(handle, reference), into(frame, relative), into(frame, turning)


def state_from(
    world: Any, pose: Sequence[float], linear: Sequence[float], angular: Sequence[float], reference: int | None
) -> tuple[Sequence[float], Sequence[float], Sequence[float]]:
    """Return pose, linear and angular velocity in the world from those relative to `reference`; inverse of state_in."""
    if reference is None:
        return pose, linear, angular
    frame = world.pose(reference)
    frame_linear, frame_angular = world.velocity(reference)
    placed: list[float] = world.pose_from(pose, reference)
    carried = _cross(frame_angular, _difference(placed[:3], frame[:3]))
    moving = _sum(_sum(frame_linear, carried), out_of(frame, linear))
    return placed, moving, _sum(frame_angular, out_of(frame, angular))


def _sum(a: Sequence[float], b: Sequence[float]) -> Vector:
    return [x + y for x, y in zip(a, b, strict=True)]


def _difference(a: Sequence[float], b: Sequence[float]) -> Vector:
    return [x - y for x, y in zip(a, b, strict=True)]


def _cross(a: Sequence[float], b: Sequence[float]) -> Vector:
    return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]


def into(frame: Sequence[float], vector: Sequence[float]) -> Vector:
    """Transform a vector from world axes into the axes of a frame."""
    columns = zip(*matrix(frame[3:]), strict=True)
    return [sum(x * y for x, y in zip(column, vector, strict=True)) for column in columns]


def out_of(frame: Sequence[float], vector: Sequence[float]) -> Vector:
    """Transform a vector from the axes of a frame into world axes."""
    return [sum(x * y for x, y in zip(row, vector, strict=True)) for row in matrix(frame[3:])]
