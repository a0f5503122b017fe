# SPDX-License-Identifier: BSD-3-Clause
"""Driving by a stick that is pushed somewhere, with the mouse on a screen or in a hand."""

import math
from dataclasses import dataclass

from bubblesim.controllers.keyboard_teleop import Velocity


@dataclass(frozen=True)
class StickTeleop:
    """What the stick means at its ends."""

    speed: float = 0.5  # m/s
    turn: float = 1.0  # rad/s
    dead_zone: float = 0.1  # share of the way that counts as none

    def __post_init__(self) -> None:
        """Raises ValueError for what no stick can have."""
        if not (math.isfinite(self.speed) and math.isfinite(self.turn) and 0.0 <= self.dead_zone < 1.0):
            raise ValueError("speed and turn must be finite, and dead_zone from 0 to below 1")

    def velocity(self, forward: float, left: float) -> Velocity:
        """For a stick that is pushed so, from -1 to 1; what is beyond counts as that."""
        return Velocity(forward=self.speed * self._share(forward), turning=self.turn * self._share(left))

    def _share(self, way: float) -> float:
        beyond = max(0.0, min(abs(way), 1.0) - self.dead_zone) / (1.0 - self.dead_zone)
        return math.copysign(beyond, way) if beyond else 0.0
