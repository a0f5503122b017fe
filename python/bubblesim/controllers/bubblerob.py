# SPDX-License-Identifier: BSD-3-Clause
"""Drives BubbleRob: straight on, and backwards in a curve for a while after its nose has sensed something."""

import math
from dataclasses import dataclass, field
from enum import Enum


@dataclass(frozen=True)
class WheelSpeeds:
    """Angular velocities of the two wheels, rad/s; positive drives forward."""

    left: float
    right: float


FORWARD = WheelSpeeds(left=math.pi, right=math.pi)
BACK_IN_A_CURVE = WheelSpeeds(left=-math.pi, right=-math.pi / 4.0)
STOPPED = WheelSpeeds(left=0.0, right=0.0)
BACKING_TIME = 3.0  # s of simulated time


class BubbleRob:
    """Decides the wheel speeds from the simulated time and the nose."""

    def __init__(self) -> None:
        """Starts driving forward."""
        self._backing_since: float | None = None

    def update(self, time: float, sensed: bool) -> WheelSpeeds:
        """Wheel speeds at this simulated time (s), given whether the nose senses something."""
        since = self._backing_since
        if since is not None and not since <= time < since + BACKING_TIME:  # over, or the simulation started anew
            since = None
        if since is None and sensed:
            since = time
        self._backing_since = since
        return FORWARD if since is None else BACK_IN_A_CURVE


class Wheel(Enum):
    """The two topics that drive BubbleRob."""

    LEFT = "left"
    RIGHT = "right"

    @property
    def other(self) -> "Wheel":
        """The wheel on the other side."""
        return Wheel.RIGHT if self is Wheel.LEFT else Wheel.LEFT


@dataclass(frozen=True)
class Order:
    """A speed for one wheel, rad/s."""

    wheel: Wheel
    speed: float


@dataclass
class HandOver:
    """Yields the wheels to whoever else publishes to them, and takes them back when they are gone.

    Two publishers on a topic would otherwise fight, message by message.
    """

    own_name: str  # of this node, as messages carry it
    drivers: set[str] = field(default_factory=set)  # the others that drive now

    @property
    def yielded(self) -> bool:
        """Whether somebody else drives."""
        return bool(self.drivers)

    def heard(self, wheel: Wheel, speed: float, publisher: str) -> list[Order]:
        """A message arrived for a wheel. Returns what to publish in answer.

        Our own last commands may have arrived behind the other's first one, so this is said again, and the wheel that
        the other has not spoken for is stopped. Only the first message of a driver is answered.
        """
        if publisher in (self.own_name, *self.drivers):
            return []
        first = not self.yielded
        self.drivers.add(publisher)
        return [Order(wheel, speed), Order(wheel.other, 0.0)] if first else []

    def connected(self, publishers: set[str]) -> bool:
        """Names all that publish to the wheels now. Returns whether this gave the wheels back to us."""
        was_yielded = self.yielded
        self.drivers &= publishers
        return was_yielded and not self.yielded
