# SPDX-License-Identifier: BSD-3-Clause
"""gz-sim's SpeedLimiter: the velocity, acceleration and jerk of a command."""

from __future__ import annotations

import math
from dataclasses import dataclass

from bubblesim.gazebo_plugins.parameters import Parameters

_Range = tuple[float, float]


def _read(parameters: Parameters, what: str) -> _Range:
    return parameters.number(f"min_{what}", -math.inf), parameters.number(f"max_{what}", math.inf)


def _within(value: float, limits: _Range) -> float:
    return max(limits[0], min(limits[1], value))


@dataclass
class SpeedLimiter:
    """Ranges in m/s, m/s^2 and m/s^3, or in rad; the last two commands are its state."""

    velocity: _Range
    acceleration: _Range
    jerk: _Range
    last: float = 0.0
    before: float = 0.0

    @classmethod
    def of(cls, parameters: Parameters) -> SpeedLimiter:
        """Read the limits: min_velocity, max_velocity, and those of acceleration and jerk."""
        return cls(_read(parameters, "velocity"), _read(parameters, "acceleration"), _read(parameters, "jerk"))

    def limited(self, wanted: float, duration: float) -> float:
        """Return the command after a time in s."""
        change = (self.last - self.before) / duration
        jerk = _within(((wanted - self.last) / duration - change) / duration, self.jerk)
        acceleration = _within(change + jerk * duration, self.acceleration)
        self.before, self.last = self.last, _within(self.last + acceleration * duration, self.velocity)
        return self.last

    def reset(self) -> None:
        """Forget the last commands."""
        self.last = self.before = 0.0
