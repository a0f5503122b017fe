# SPDX-License-Identifier: BSD-3-Clause
"""Drives a tricycle around obstacles by a single sonar that looks ahead."""

import math
from dataclasses import dataclass


@dataclass(frozen=True)
class Settings:
    """What the controller may be tuned by."""

    full_speed: float = 1.0  # rad/s of the front wheel
    slow_speed: float = 0.5  # rad/s, while something is near
    near: float = 1.0  # m
    avoiding_steering: float = math.radians(70.0)  # rad, positive to the left
    recovery: float = 0.05  # share by which a step straightens and speeds up
    patience: float = 1.0  # s without a reading, after which it stops


@dataclass(frozen=True)
class Command:
    """What the tricycle should do."""

    steering: float  # rad
    speed: float  # rad/s of the front wheel


def is_reading(distance: float) -> bool:
    """Whether a sonar may report this distance: metres, or +Inf when it hears no echo (REP 117)."""
    return distance >= 0.0  # False for NaN


class TricycleAvoid:
    """Turns away from what is near, otherwise straightens and speeds up little by little."""

    def __init__(self, settings: Settings | None = None) -> None:
        """Starts straight and slow; None takes the default settings."""
        self.settings = settings or Settings()
        self.stopped = False  # for want of readings
        self._command = Command(steering=0.0, speed=self.settings.slow_speed)
        self._silence = 0.0

    def update(self, distance: float | None, dt: float) -> Command | None:
        """One step for a reading; with None (nothing heard) it only counts the time and stops when that gets long.

        Args:
            distance: what the sonar measured, m, or None.
            dt: time since the last call, s.

        Returns:
            The new command, or None when the last one stands.
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
        self._silence += max(dt, 0.0)  # simulated time jumps back when the simulation starts anew
        if self.stopped or self._silence < self.settings.patience:
            return None
        self.stopped = True
        self._command = Command(self._command.steering, 0.0)
        return self._command
