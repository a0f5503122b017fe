# SPDX-License-Identifier: BSD-3-Clause
"""Drives BubbleRob: straight on, and backwards in a curve for a while after its nose has detected something."""

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
    """Computes the wheel speeds from the simulated time and the nose sensor."""

    def __init__(self) -> None:
        """Start driving forward."""
        self._backing_since: float | None = None

    def update(self, time: float, sensed: bool) -> WheelSpeeds:
        """Return the wheel speeds at this simulated time (s); ``sensed``: whether the nose detects something."""
        since = self._backing_since
        if since is not None and not since <= time < since + BACKING_TIME:  # over, or the simulation restarted
            since = None
        if since is None and sensed:
            since = time
        self._backing_since = since
        return FORWARD if since is None else BACK_IN_A_CURVE


class Wheel(Enum):
    """The wheels, each with its topic."""

    LEFT = "left"
    RIGHT = "right"

    @property
    def other(self) -> "Wheel":
        """Return the wheel on the other side."""
        return Wheel.RIGHT if self is Wheel.LEFT else Wheel.LEFT


@dataclass(frozen=True)
class Order:
    """A speed for one wheel, rad/s."""

    wheel: Wheel
    speed: float


@dataclass
class HandOver:
    """Stops publishing while another node publishes to the wheels' topics, and resumes when that node is gone.

    Otherwise the commands of two publishers on a topic would alternate.
    """

    own_name: str  # of this node, as messages carry it
    drivers: set[str] = field(default_factory=set)  # other nodes that publish now

    @property
    def yielded(self) -> bool:
        """Return whether another node is publishing."""
        return bool(self.drivers)

    def on_command(self, wheel: Wheel, speed: float, publisher: str) -> list[Order]:
        """Handle a message for a wheel. Return the messages to publish in response.

        Our last commands may have arrived after the other node's first one. So its command is repeated, and the wheel
        that it has not commanded is stopped. Only the first message of a publisher has a response.
        """
        if publisher in (self.own_name, *self.drivers):
            return []
        first = not self.yielded
        self.drivers.add(publisher)
        return [Order(wheel, speed), Order(wheel.other, 0.0)] if first else []

    def set_publishers(self, publishers: set[str]) -> bool:
        """Update the set of current publishers. Return whether we are in control again because of this."""
        was_yielded = self.yielded
        self.drivers &= publishers
        return was_yielded and not self.yielded
