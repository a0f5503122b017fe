# SPDX-License-Identifier: BSD-3-Clause
"""Speeds with limited acceleration."""

from dataclasses import dataclass


def approached(now: float, wanted: float, most: float) -> float:
    """Return the value nearest to ``wanted`` that is at most ``most`` away from ``now``."""
    return now + max(-most, min(wanted - now, most))


@dataclass
class SpeedRamp:
    """Speed ramp of several wheels, each limited separately."""

    acceleration: float  # rad/s^2; 0: no limit
    speeds: tuple[float, ...]  # rad/s

    def update(self, wanted: tuple[float, ...], dt: float) -> tuple[float, ...]:
        """Return the speeds ``dt`` seconds later."""
        if self.acceleration > 0:
            most = self.acceleration * dt
            self.speeds = tuple(approached(now, to, most) for now, to in zip(self.speeds, wanted, strict=True))
        else:
            self.speeds = wanted
        return self.speeds
