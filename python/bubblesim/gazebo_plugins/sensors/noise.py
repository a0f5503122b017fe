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
        noise = self.draw(len(values))
        return list(values) if noise is None else [value + off for value, off in zip(values, noise, strict=True)]

    def draw(self, size: int) -> list[float] | None:
        """Return the noise of values, None if there is none."""
        if not any(self._deviations):
            return None
        return [float(self._random.normal(0.0, self._of(i))) for i in range(size)]

    def variances(self, size: int) -> list[float]:
        """Return the variances of values."""
        return [self._of(i) ** 2 for i in range(size)]

    def _of(self, i: int) -> float:
        return self._deviations[i % len(self._deviations)]
