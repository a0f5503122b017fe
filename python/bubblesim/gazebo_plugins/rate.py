# SPDX-License-Identifier: BSD-3-Clause
"""Publish rates, limited by the simulation step."""

from __future__ import annotations

from typing import Any


class Rate:
    """Selects the steps at which something is due: the first time one period after its creation, as in Gazebo.

    So what has the same rate is due at the same times: 10 Hz at 0.1 s, 0.2 s, ... of the time of the state.
    """

    def __init__(self, hertz: float, simulation: Any) -> None:
        """A rate of 0 Hz selects every step of the simulation."""
        self._period = 1.0 / hertz if hertz > 0 else 0.0
        self._simulation = simulation
        self._begin()

    def _begin(self) -> None:
        self._time = float(self._simulation.state_time)
        self._due = self._time + self._period

    def due(self) -> bool:
        """Return whether it is due in this step; call it after the physics, at most once per step."""
        self._time = float(self._simulation.state_time)
        if self._due > self._time + self._simulation.time_step / 2:  # rounding must not shift it to the next step
            return False
        self._due += self._period
        if self._due <= self._time:  # it was not called for some time
            self._due = self._time + self._period
        return True

    def reset(self) -> None:
        """Start again if the time did; go on after a reset of the world alone."""
        if self._simulation.state_time < self._time:
            self._begin()
