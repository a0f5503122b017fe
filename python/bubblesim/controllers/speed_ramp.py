# SPDX-License-Identifier: BSD-3-Clause
"""Speeds that change no faster than an acceleration allows."""

from dataclasses import dataclass


def approached(now: float, wanted: float, most: float) -> float:
    """The value nearest to ``wanted`` that is at most ``most`` away from ``now``."""
    return now + max(-most, min(wanted - now, most))


@dataclass
class SpeedRamp:
    """Of some wheels, each by itself."""

    acceleration: float  # rad/s^2; 0 sets no limit
    speeds: tuple[float, ...]  # rad/s

    def update(self, wanted: tuple[float, ...], dt: float) -> tuple[float, ...]:
        """The speeds ``dt`` seconds later."""
        if self.acceleration > 0:
            most = self.acceleration * dt
            self.speeds = tuple(approached(now, to, most) for now, to in zip(self.speeds, wanted, strict=True))
        else:
            self.speeds = wanted
        return self.speeds
