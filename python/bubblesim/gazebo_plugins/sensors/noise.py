# SPDX-License-Identifier: BSD-3-Clause
"""The Gaussian noise that plugins add by themselves."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from bubblesim.gazebo_plugins.device import Device


class Noise:
    """Follows from the simulation's seed and the device's place alone: equal after each reset."""

    def __init__(self, device: Device, *deviations: float) -> None:
        """``deviations``: standard deviation, in the unit of what it is added to; three of them along x, y and z."""
        self._seed = [device.simulation.seed, device.context.owner]
        self._deviations = deviations
        self.reset()

    def reset(self) -> None:
        """Begin again."""
        self._random = np.random.default_rng(self._seed)

    def on(self, values: Sequence[float]) -> list[float]:
        """The values with noise."""
        if not any(self._deviations):
            return list(values)
        return [value + float(self._random.normal(0.0, self._of(i))) for i, value in enumerate(values)]

    def covariance(self, size: int) -> list[float]:
        """The matrix of size x size that belongs to it."""
        return [self._of(row) ** 2 if row == column else 0.0 for row in range(size) for column in range(size)]

    def _of(self, i: int) -> float:
        return self._deviations[i % len(self._deviations)]
