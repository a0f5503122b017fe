# SPDX-License-Identifier: BSD-3-Clause
"""How what stands on a floor moves: its velocity, its pose, from the one to the other."""

from __future__ import annotations

import math
from dataclasses import dataclass


@dataclass(frozen=True)
class Velocity:
    """Of a robot's reference point, between its unsteered wheels."""

    linear: float  # m/s, forward
    angular: float  # rad/s, to the left

    def require_finite(self) -> None:
        """Raises ValueError when one is not finite."""
        if not (math.isfinite(self.linear) and math.isfinite(self.angular)):
            raise ValueError(f"a velocity of {self.linear} m/s and {self.angular} rad/s is not finite")


@dataclass(frozen=True)
class Pose2D:
    """Where the reference point is, in the odometry's frame."""

    x: float = 0.0  # m
    y: float = 0.0  # m
    heading: float = 0.0  # rad


def moved(pose: Pose2D, velocity: Velocity, dt: float) -> Pose2D:
    """Pose after ``dt`` seconds at a constant velocity: along an arc, exactly."""
    turned = velocity.angular * dt
    half = turned / 2
    chord = velocity.linear * dt * (math.sin(half) / half if half else 1.0)
    return Pose2D(
        pose.x + chord * math.cos(pose.heading + half),
        pose.y + chord * math.sin(pose.heading + half),
        math.remainder(pose.heading + turned, math.tau),
    )
