# SPDX-License-Identifier: BSD-3-Clause
"""The length of the simulation step that publishes at the rates of robots, as Gazebo does with steps of 1 ms."""

from __future__ import annotations

import contextlib
from collections.abc import Collection
from typing import Any

_EXACT_FROM = 0.005  # s: a shorter step is not chosen to keep a rate exactly
_TOLERANCE = 0.01  # of a period
_RATES = ("updaterate", "odompublishfrequency", "publishrate")  # names of parameters, without underscores


def step_for(rates: Collection[float], substep: float, longest: float) -> float:
    """Return the longest step, s, in which no rate is due twice, and of which all periods are multiples if possible.

    :param rates: Hz, above 0.
    :param substep: s; the step is a multiple of it.
    :param longest: s.
    """
    periods = [1.0 / rate for rate in rates]
    most = max(1, int(min([longest, *periods]) / substep + 1e-6))
    for count in range(most, 0, -1):
        step = count * substep
        if step < _EXACT_FROM:
            break
        if all(abs(period / step - round(period / step)) <= _TOLERANCE for period in periods):
            return step
    return most * substep


def rate_of(plugin: Any) -> float:
    """Return the rate in a plugin's parameters, Hz; 0 if it has none."""
    for parameter in plugin.parameters:
        if parameter.name.replace("_", "").lower() in _RATES:
            with contextlib.suppress(ValueError):  # which the plugin reports
                return float(parameter.text)
    return 0.0


class StepLength:
    """Shortens the step when a model with a faster rate comes; it stays when the model goes."""

    def __init__(self, simulation: Any, *, enabled: bool) -> None:
        """:param enabled: if not, the step stays as it is."""
        self._simulation = simulation
        self._enabled = enabled
        self._longest = simulation.time_step
        self._rates: set[float] = set()

    def need(self, rate: float) -> None:
        """Fit the step to one more rate, Hz; 0 has no effect."""
        if rate > 0.0 and rate not in self._rates:
            self._rates.add(rate)
            self.fit()

    def fit(self) -> None:
        """Set the step of the simulation, also after a reset has put back that of the scene."""
        if not self._enabled or not self._rates:
            return
        step = step_for(self._rates, self._simulation.substep, self._longest)
        if step != self._simulation.time_step:
            self._simulation.set_time_step(step)
