# SPDX-License-Identifier: BSD-3-Clause
"""What a device's sensor measured anew."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from bubblesim._core import reading_time
from bubblesim.gazebo_plugins.device import Device
from bubblesim.gazebo_plugins.rate import Rate


class NewReadings:
    """Each measurement once. A sensor that is not asked does not measure."""

    def __init__(
        self, device: Device, read: Callable[[Any, int], Any], hertz: float = 0.0, sensor: int | None = None
    ) -> None:
        """``read`` is a function of ``bubblesim._core`` such as ``read_lidar``; at most ``hertz``, 0 for all.

        Without ``sensor``, a handle, the sensor is that which has the plugin.
        """
        self._device = device
        self._sensor = device.context.owner if sensor is None else sensor
        self._read = read
        self._rate = Rate(hertz, device.simulation.time_step)
        self._time: float | None = None

    def take(self) -> Any | None:
        """The reading of this step, None when the sensor was not due; to be asked in each step with a listener."""
        return self._read(self._device.simulation, self._sensor) if self.due() else None

    def due(self) -> bool:
        """Whether there is a new one to be taken in this step, without having the sensor measure."""
        time = reading_time(self._device.simulation, self._sensor)
        if time == self._time:
            return False
        self._time = time
        return self._rate.due(self._device.simulation.time)

    def reset(self) -> None:
        """Time may start again."""
        self._time = None
        self._rate.reset()
