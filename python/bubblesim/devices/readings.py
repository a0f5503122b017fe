# SPDX-License-Identifier: BSD-3-Clause
"""What a device's sensor measured anew."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from bubblesim.devices.device import Device
from bubblesim.devices.rate import Rate


class NewReadings:
    """Each measurement once. A sensor that is not asked does not measure."""

    def __init__(self, device: Device, read: Callable[[Any, int], Any], hertz: float = 0.0) -> None:
        """``read`` is a function of ``bubblesim._core`` such as ``read_lidar``; at most ``hertz``, 0 for all."""
        self._device = device
        self._read = read
        self._rate = Rate(hertz, device.simulation.time_step)
        self._time: float | None = None

    def take(self) -> Any | None:
        """The reading of this pass, None when the sensor was not due; to be asked in each pass with a listener."""
        reading = self._read(self._device.simulation, self._device.place.owner)
        if reading.time == self._time:
            return None
        self._time = reading.time
        return reading if self._rate.due(self._device.simulation.time) else None

    def reset(self) -> None:
        """Time may start again."""
        self._time = None
        self._rate.reset()
