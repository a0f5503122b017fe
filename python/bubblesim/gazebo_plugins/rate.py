# SPDX-License-Identifier: BSD-3-Clause
"""Publish rates, limited by the simulation step."""

from __future__ import annotations


class Rate:
    """Selects the steps at which something is due."""

    def __init__(self, hertz: float, time_step: float) -> None:
        """A rate of 0 Hz selects every step; ``time_step`` in seconds."""
        self._period = 1.0 / hertz if hertz > 0 else 0.0
        self._tolerance = time_step / 2  # rounding must not shift a due time to the next step
        self._due = 0.0

    def due(self, time: float) -> bool:
        """Return whether it is due in the step of this time; call it once per step."""
        if self._due > time + self._tolerance:
            return False
        self._due = max(self._due + self._period, time)
        return True

    def reset(self) -> None:
        """Reset after simulated time restarted."""
        self._due = 0.0
