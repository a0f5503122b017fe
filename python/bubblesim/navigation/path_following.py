# SPDX-License-Identifier: BSD-3-Clause
"""Path following by pure pursuit (Coulter 1992, CMU-RI-TR-92-01), and stopping for obstacles."""

import math
from collections.abc import Iterable, Sequence
from dataclasses import dataclass

from bubblesim.controllers.planar_motion import Pose2D, Velocity
from bubblesim.navigation.planar import Point, seen_from

STANDING = Velocity(0.0, 0.0)
ALIGNED = 0.1  # rad


@dataclass(frozen=True)
class Driver:
    """Driving parameters of a robot. Lengths in m."""

    max_speed: float = 0.4  # m/s
    max_turn: float = 0.8  # rad/s
    acceleration: float = 0.4  # m/s2, for slowing down before the end
    lookahead: float = 0.4  # along the path, distance to the target point
    turning_radius: float = 0.0  # minimum; 0 for a robot that turns on the spot
    radius: float = 0.3  # of the robot
    tolerance: float = 0.1  # distance at which the goal is reached


def follow(path: Sequence[Point], pose: Pose2D, driver: Driver) -> Velocity | None:
    """Return the velocity to follow the path, None at its end."""
    remaining = math.dist((pose.x, pose.y), path[-1])
    if remaining <= driver.tolerance:
        return None
    forward, left = seen_from(pose, _target(path, pose, driver.lookahead))
    angle = math.atan2(left, forward)
    speed = min(driver.max_speed, math.sqrt(2 * driver.acceleration * remaining))
    if driver.turning_radius == 0.0 and abs(angle) > math.pi / 4:
        return _turn(angle, driver)
    curvature = 2 * left / (forward**2 + left**2)
    if forward < 0.0:  # behind: use the tightest curve
        curvature = math.copysign(1 / driver.turning_radius, left)
    elif driver.turning_radius > 0.0:
        curvature = math.copysign(min(abs(curvature), 1 / driver.turning_radius), curvature)
    speed = min(speed, driver.max_turn / max(abs(curvature), 1e-6))
    return Velocity(speed, speed * curvature)


def face(path: Sequence[Point], pose: Pose2D, driver: Driver) -> Velocity:
    """Return a turn on the spot towards the path; STANDING if aligned, or if the robot cannot turn on the spot."""
    forward, left = seen_from(pose, _target(path, pose, driver.lookahead))
    return turn(math.atan2(left, forward), driver)


def turn(angle: float, driver: Driver) -> Velocity:
    """Return a turn on the spot by an angle; STANDING if it is small, or if the robot cannot turn on the spot."""
    return STANDING if driver.turning_radius > 0.0 or abs(angle) < ALIGNED else _turn(angle, driver)


def _turn(angle: float, driver: Driver) -> Velocity:
    return Velocity(0.0, math.copysign(min(driver.max_turn, 2 * abs(angle)), angle))


def _target(path: Sequence[Point], pose: Pose2D, lookahead: float) -> Point:
    """Return the point of the path that is `lookahead` beyond the one nearest to the robot."""
    here = (pose.x, pose.y)
    nearest = min(range(len(path)), key=lambda index: math.dist(path[index], here))
    for index in range(nearest, len(path)):
        if math.dist(path[index], here) >= lookahead:
            return path[index]
    return path[-1]


def is_blocked(command: Velocity, obstacles: Iterable[Point], driver: Driver) -> bool:
    """Return whether an obstacle, in the robot's frame, is in the way within the braking distance of a command."""
    if command.linear <= 0.0:
        return False
    reach = driver.radius + 0.1 + command.linear**2 / (2 * driver.acceleration)
    curvature = command.angular / command.linear
    for forward, left in obstacles:
        if 0.0 < forward < reach and abs(left - curvature * forward**2 / 2) < driver.radius:
            return True
    return False
