# SPDX-License-Identifier: BSD-3-Clause
"""Tricycle drive: steering angle and speed of the front wheel from the tricycle's velocity, and back.

The bicycle model: the body turns about the point where the front wheel's axle meets the line through the rear axle
(K. Lynch, F. Park, Modern Robotics, section 13.3.1: a car with a steered front wheel, which here is also driven).
"""

import math
from dataclasses import dataclass

from bubblesim.controllers.planar_motion import Velocity


@dataclass(frozen=True)
class Tricycle:
    """Dimensions and limits of a tricycle; the defaults are those of the tricycle in the scenes."""

    wheelbase: float = 1.0  # m, from the rear axle to the front wheel
    wheel_radius: float = 0.3  # m, of the front wheel
    max_steering: float = 1.5  # rad, to either side
    max_speed: float = 10.0  # rad/s of the front wheel

    def __post_init__(self) -> None:
        """Raise ValueError for invalid dimensions."""
        for name, value in vars(self).items():
            if not 0.0 < value < math.inf:
                raise ValueError(f"{name} is {value}, it must be above 0 and finite")
        if self.max_steering > math.pi / 2:
            raise ValueError(f"max_steering is {self.max_steering} rad, it must be at most pi/2")


@dataclass(frozen=True)
class FrontWheel:
    """Command or state of the front wheel."""

    steering: float  # rad, positive to the left
    speed: float  # rad/s, positive forward


def front_wheel(tricycle: Tricycle, wanted: Velocity, steering_now: float = 0.0) -> FrontWheel:
    """Return the front wheel's command for a velocity, limited on the same curve to what the tricycle can do.

    At zero velocity the wheel keeps its angle, ``steering_now``.

    :raises ValueError: when the velocity is not finite.
    """
    wanted.require_finite()
    sideways = wanted.angular * tricycle.wheelbase  # m/s, of the front wheel's centre
    if wanted.linear == 0.0 and sideways == 0.0:
        return FrontWheel(steering_now, 0.0)
    # A wheel turned by more than 90 degrees equals one turned the other way that rolls backwards.
    steering = math.atan(sideways / wanted.linear) if wanted.linear else math.copysign(math.pi / 2, sideways)
    steering = max(-tricycle.max_steering, min(steering, tricycle.max_steering))
    along = wanted.linear * math.cos(steering) + sideways * math.sin(steering)  # m/s, in the rolling direction
    speed = along / tricycle.wheel_radius
    return FrontWheel(steering, max(-tricycle.max_speed, min(speed, tricycle.max_speed)))


def velocity(tricycle: Tricycle, wheel: FrontWheel) -> Velocity:
    """Return the velocity of the tricycle when its front wheel rolls without slipping."""
    along = wheel.speed * tricycle.wheel_radius
    return Velocity(along * math.cos(wheel.steering), along * math.sin(wheel.steering) / tricycle.wheelbase)
