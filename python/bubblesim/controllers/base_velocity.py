# SPDX-License-Identifier: BSD-3-Clause
"""The commanded velocity of a robot's base, which may also move sideways."""

from dataclasses import dataclass


@dataclass(frozen=True)
class BaseVelocity:
    """Velocity of the robot's base, REP 103."""

    forward: float = 0.0  # m/s
    left: float = 0.0  # m/s
    turning: float = 0.0  # rad/s, to the left


STANDING = BaseVelocity()
