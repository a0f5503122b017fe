# SPDX-License-Identifier: BSD-3-Clause
"""Drives a tricycle around obstacles with a single forward sonar."""

import math
from dataclasses import dataclass


@dataclass(frozen=True)
class Settings:
    """Parameters of the controller."""

    full_speed: float = 1.0  # rad/s of the front wheel
    slow_speed: float = 0.5  # rad/s, near an obstacle
    near: float = 1.0  # m
    avoiding_steering: float = math.radians(70.0)  # rad, positive to the left
    recovery: float = 0.05  # fraction by which each step straightens and speeds up
    timeout: float = 1.0  # s without a reading before it stops


@dataclass(frozen=True)
class Command:
    """A command to the tricycle."""

    steering: float  # rad
    speed: float  # rad/s of the front wheel


def is_reading(distance: float) -> bool:
    """Return whether this is a valid sonar distance: metres, or +Inf without an echo (REP 117)."""
    return distance >= 0.0  # False for NaN


class TricycleAvoid:
    """Steers away from near obstacles, otherwise gradually straightens and speeds up."""

    def __init__(self, settings: Settings | None = None) -> None:
        """Start straight and slow; None means the default settings."""
        self.settings = settings or Settings()
        self.stopped = False  # because readings are missing
        self._command = Command(steering=0.0, speed=self.settings.slow_speed)
        self._silence = 0.0

    def update(self, distance: float | None, dt: float) -> Command | None:
        """Process one reading; with None (no reading) only count the time, and stop when the timeout is exceeded.

        Args:
            distance: the measured distance, m, or None.
            dt: time since the last call, s.

        Returns:
            The new command, or None if the last one is unchanged.
        """
        if distance is None or not is_reading(distance):
            return self._wait(dt)
        if self.stopped:
            self.stopped = False
            self._command = Command(self._command.steering, self.settings.slow_speed)
        self._silence = 0.0
        if distance < self.settings.near:
            self._command = Command(self.settings.avoiding_steering, self.settings.slow_speed)
        else:
            self._command = Command(
                steering=self._command.steering * (1.0 - self.settings.recovery),
                speed=min(self._command.speed * (1.0 + self.settings.recovery), self.settings.full_speed),
            )
        return self._command

    def _wait(self, dt: float) -> Command | None:
        self._silence += max(dt, 0.0)  # simulated time jumps back when the simulation restarts
        if self.stopped or self._silence < self.settings.timeout:
            return None
        self.stopped = True
        self._command = Command(self._command.steering, 0.0)
        return self._command
