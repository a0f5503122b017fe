# SPDX-License-Identifier: BSD-3-Clause
"""How often something is done, at most once a step."""

from __future__ import annotations


class Rate:
    """Passes at which something is due."""

    def __init__(self, hertz: float, time_step: float) -> None:
        """0 Hz stands for each step, which takes ``time_step`` seconds."""
        self._period = 1.0 / hertz if hertz > 0 else 0.0
        self._tolerance = time_step / 2  # a time that lies on a step must not slip to the next by rounding
        self._due = 0.0

    def due(self, time: float) -> bool:
        """Whether it is due in the step of this time, to be asked once in a step."""
        if self._due > time + self._tolerance:
            return False
        self._due = max(self._due + self._period, time)
        return True

    def reset(self) -> None:
        """Time starts again."""
        self._due = 0.0
