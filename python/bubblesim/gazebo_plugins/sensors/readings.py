# SPDX-License-Identifier: BSD-3-Clause
"""New measurements of a plugin's sensor."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from bubblesim._core import reading_time
from bubblesim.gazebo_plugins.plugin import Plugin
from bubblesim.gazebo_plugins.rate import Rate


class NewReadings:
    """The measurements of the steps in which the sensor was due. The sensor measures only on request.

    A measurement shows the state with whose time messages of this step are stamped.
    """

    def __init__(
        self, plugin: Plugin, read: Callable[[Any, int], Any], hertz: float = 0.0, sensor: int | None = None
    ) -> None:
        """``read``: a function of ``bubblesim._core`` such as ``read_lidar``; ``hertz``: the maximum rate, 0 for all.

        ``sensor`` is a handle; default: the sensor that has the plugin.
        """
        self._plugin = plugin
        self._sensor = plugin.context.owner if sensor is None else sensor
        self._read = read
        self._rate = Rate(hertz, plugin.simulation)

    def take(self) -> Any | None:
        """Return the reading of this step, None if the sensor is not due; call it in each step with subscribers."""
        return self._read(self._plugin.simulation, self._sensor) if self.due() else None

    def due(self) -> bool:
        """Return whether there is a new reading in this step, without triggering the measurement."""
        return is_new(self._plugin.simulation, self._sensor) and self._rate.due()

    def reset(self) -> None:
        """Reset the rate."""
        self._rate.reset()


def is_new(simulation: Any, sensor: int) -> bool:
    """Return whether a sensor was due in this step, or measured on request; call it after the physics."""
    return bool(reading_time(simulation, sensor) == simulation.state_time)
