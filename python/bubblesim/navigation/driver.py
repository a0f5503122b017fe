# SPDX-License-Identifier: BSD-3-Clause
"""Driving parameters of a robot, and turns in place."""

import math
from dataclasses import dataclass

from bubblesim.controllers.planar_motion import Velocity

STANDING = Velocity(0.0, 0.0)


@dataclass(frozen=True)
class Driver:
    """Driving parameters of a robot. Lengths in m."""

    max_speed: float = 0.4  # m/s
    max_turn: float = 0.8  # rad/s
    acceleration: float = 0.4  # m/s2, for slowing down before the end
    lookahead: float = 0.4  # along the path, distance to the target point
    turning_radius: float = 0.0  # minimum; 0 for a robot that turns in place
    radius: float = 0.3  # of the robot
    tolerance: float = 0.1  # distance at which the goal is reached
    yaw_tolerance: float = 0.1  # rad, of the heading at the goal


def turn(angle: float, driver: Driver) -> Velocity:
    """Return a turn in place by an angle; STANDING if it is small, or if the robot cannot turn in place."""
    return STANDING if driver.turning_radius > 0.0 or abs(angle) < driver.yaw_tolerance else turn_towards(angle, driver)


def turn_towards(angle: float, driver: Driver) -> Velocity:
    """Return a turn in place by an angle, slower at its end."""
    return Velocity(0.0, math.copysign(min(driver.max_turn, 2 * abs(angle)), angle))
