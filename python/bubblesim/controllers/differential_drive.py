# SPDX-License-Identifier: BSD-3-Clause
"""Differential drive: wheel speeds from the robot's velocity, and odometry from the wheels' angles.

The wheels roll without slipping (K. Lynch, F. Park, Modern Robotics, section 13.3.1: the diff-drive robot).
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass

from bubblesim.controllers.planar_motion import Pose2D, Velocity, moved


@dataclass(frozen=True)
class DifferentialDrive:
    """Dimensions and limits of the robot."""

    wheel_radius: float  # m
    track: float  # m, between the wheels
    max_speed: float = math.inf  # rad/s of a wheel

    def __post_init__(self) -> None:
        """Raise ValueError for invalid dimensions."""
        for name, value in vars(self).items():
            if not value > 0.0:
                raise ValueError(f"{name} is {value}, it must be above 0")


@dataclass(frozen=True)
class Wheels:
    """Values of the left and the right wheel: angles in rad or speeds in rad/s, positive forward."""

    left: float
    right: float


def wheel_speeds(drive: DifferentialDrive, wanted: Velocity) -> Wheels:
    """Return the wheel speeds for a velocity, scaled down on the same curve if a wheel would exceed its maximum.

    :raises ValueError: when the velocity is not finite.
    """
    wanted.require_finite()
    across = wanted.angular * drive.track / 2  # m/s, difference of the wheels' speeds from the middle's
    left, right = (wanted.linear - across) / drive.wheel_radius, (wanted.linear + across) / drive.wheel_radius
    scale = min(1.0, drive.max_speed / max(abs(left), abs(right), 1e-300))
    return Wheels(left * scale, right * scale)


def velocity(drive: DifferentialDrive, speeds: Wheels) -> Velocity:
    """Return the velocity of a robot whose wheels turn at these speeds."""
    left, right = speeds.left * drive.wheel_radius, speeds.right * drive.wheel_radius
    return Velocity((left + right) / 2, (right - left) / drive.track)


class WheelOdometry:
    """Odometry from wheel encoders."""

    def __init__(self, drive: DifferentialDrive, angles: Wheels, error: Callable[[], float] = lambda: 0.0) -> None:
        """Start at the origin with the wheels at ``angles``.

        :param error: returns the relative error of each measured step of each wheel.
        """
        self.pose = Pose2D()
        self.velocity = Velocity(0.0, 0.0)
        self._drive = drive
        self._angles = angles
        self._error = error

    def update(self, angles: Wheels, dt: float) -> None:
        """Process the wheels' angles ``dt`` seconds after the previous ones. Angles may wrap around at -pi and pi."""
        steps = Wheels(
            math.remainder(angles.left - self._angles.left, math.tau) * (1.0 + self._error()),
            math.remainder(angles.right - self._angles.right, math.tau) * (1.0 + self._error()),
        )
        self._angles = angles
        self.velocity = velocity(self._drive, Wheels(steps.left / dt, steps.right / dt))
        self.pose = moved(self.pose, self.velocity, dt)
