# SPDX-License-Identifier: BSD-3-Clause
"""From the velocity of a tricycle to the angle and speed of its front wheel, and back.

The bicycle model: the body turns about the point on the line through the rear axle where the front wheel's axle meets
it (K. Lynch, F. Park, Modern Robotics, section 13.3.1: a car with a steered front wheel, which here is driven, too).
"""

import math
from dataclasses import dataclass

from bubblesim.controllers.planar_motion import Velocity


@dataclass(frozen=True)
class Tricycle:
    """What a tricycle measures and can do; the values of the scenes' one."""

    wheelbase: float = 1.0  # m, from the rear axle to the front wheel
    wheel_radius: float = 0.3  # m, of the front wheel
    max_steering: float = 1.5  # rad, to either side
    max_speed: float = 10.0  # rad/s of the front wheel

    def __post_init__(self) -> None:
        """Raises ValueError for what no tricycle can be."""
        for name, value in vars(self).items():
            if not 0.0 < value < math.inf:
                raise ValueError(f"{name} is {value}, it must be above 0 and finite")
        if self.max_steering > math.pi / 2:
            raise ValueError(f"max_steering is {self.max_steering} rad, it must be at most pi/2")


@dataclass(frozen=True)
class FrontWheel:
    """What the front wheel does."""

    steering: float  # rad, positive to the left
    speed: float  # rad/s, positive forward


def front_wheel(tricycle: Tricycle, wanted: Velocity, steering_now: float = 0.0) -> FrontWheel:
    """Front wheel that gives a velocity, or within the tricycle's limits one near it, slower on the same curve.

    Standing still leaves the wheel where it is, ``steering_now``.

    :raises ValueError: when the velocity is not finite.
    """
    wanted.require_finite()
    sideways = wanted.angular * tricycle.wheelbase  # m/s, of the front wheel's centre
    if wanted.linear == 0.0 and sideways == 0.0:
        return FrontWheel(steering_now, 0.0)
    # A wheel turned by more than 90 degrees is one turned the other way that runs backwards.
    steering = math.atan(sideways / wanted.linear) if wanted.linear else math.copysign(math.pi / 2, sideways)
    steering = max(-tricycle.max_steering, min(steering, tricycle.max_steering))
    along = wanted.linear * math.cos(steering) + sideways * math.sin(steering)  # m/s, where the wheel points
    speed = along / tricycle.wheel_radius
    return FrontWheel(steering, max(-tricycle.max_speed, min(speed, tricycle.max_speed)))


def velocity(tricycle: Tricycle, wheel: FrontWheel) -> Velocity:
    """Velocity of the tricycle when its front wheel rolls without slipping."""
    along = wheel.speed * tricycle.wheel_radius
    return Velocity(along * math.cos(wheel.steering), along * math.sin(wheel.steering) / tricycle.wheelbase)
