# SPDX-License-Identifier: BSD-3-Clause
"""Planar motion: velocity, pose, and integration of a velocity."""

from __future__ import annotations

import math
from dataclasses import dataclass


@dataclass(frozen=True)
class Velocity:
    """Velocity of a robot's reference point, midway between its unsteered wheels."""

    linear: float  # m/s, forward
    angular: float  # rad/s, to the left

    def require_finite(self) -> None:
        """Raise ValueError if a component is not finite."""
        if not (math.isfinite(self.linear) and math.isfinite(self.angular)):
            raise ValueError(f"the velocity must be finite, found {self.linear} m/s and {self.angular} rad/s")


@dataclass(frozen=True)
class Pose2D:
    """Pose of the reference point in the odometry frame."""

    x: float = 0.0  # m
    y: float = 0.0  # m
    heading: float = 0.0  # rad


def moved(pose: Pose2D, velocity: Velocity, dt: float) -> Pose2D:
    """Return the pose after ``dt`` seconds at a constant velocity: the exact arc."""
    turned = velocity.angular * dt
    half = turned / 2
    chord = velocity.linear * dt * (math.sin(half) / half if half else 1.0)
    return Pose2D(
        pose.x + chord * math.cos(pose.heading + half),
        pose.y + chord * math.sin(pose.heading + half),
        math.remainder(pose.heading + turned, math.tau),
    )
