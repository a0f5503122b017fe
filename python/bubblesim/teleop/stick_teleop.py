# SPDX-License-Identifier: BSD-3-Clause
"""Teleoperation with a virtual or real stick."""

import math
from dataclasses import dataclass

from bubblesim.controllers.base_velocity import BaseVelocity


@dataclass(frozen=True)
class StickTeleop:
    """Maximum speeds and dead zone of the stick."""

    speed: float = 0.5  # m/s
    turn: float = 1.0  # rad/s
    dead_zone: float = 0.1  # fraction of the range that counts as zero

    def __post_init__(self) -> None:
        """Raise ValueError for invalid settings."""
        if not (math.isfinite(self.speed) and math.isfinite(self.turn) and 0.0 <= self.dead_zone < 1.0):
            raise ValueError("speed and turn must be finite, and dead_zone at least 0 and less than 1")

    def velocity(self, forward: float, left: float) -> BaseVelocity:
        """Return the velocity for a stick position, each axis from -1 to 1; values beyond are clamped."""
        return BaseVelocity(forward=self.speed * self._share(forward), turning=self.turn * self._share(left))

    def _share(self, way: float) -> float:
        beyond = max(0.0, min(abs(way), 1.0) - self.dead_zone) / (1.0 - self.dead_zone)
        return math.copysign(beyond, way) if beyond else 0.0
