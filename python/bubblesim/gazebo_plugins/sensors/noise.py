# SPDX-License-Identifier: BSD-3-Clause
"""Gaussian noise added by plugins."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from bubblesim.gazebo_plugins.plugin import Plugin


class Noise:
    """Depends only on the random seed and the plugin's owner: equal after each reset."""

    def __init__(self, plugin: Plugin, *deviations: float) -> None:
        """``deviations``: standard deviation, in the unit of the values; or three of them along x, y and z."""
        self._seed = [plugin.simulation.seed, plugin.context.owner]
        self._deviations = deviations
        self.reset()

    def reset(self) -> None:
        """Restart the random sequence."""
        self._random = np.random.default_rng(self._seed)

    def on(self, values: Sequence[float]) -> list[float]:
        """Return the values with noise."""
        if not any(self._deviations):
            return list(values)
        return [value + float(self._random.normal(0.0, self._of(i))) for i, value in enumerate(values)]

    def covariance(self, size: int) -> list[float]:
        """Return the covariance matrix, size x size."""
        return [self._of(row) ** 2 if row == column else 0.0 for row in range(size) for column in range(size)]

    def _of(self, i: int) -> float:
        return self._deviations[i % len(self._deviations)]
