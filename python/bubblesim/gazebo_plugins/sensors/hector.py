# SPDX-License-Identifier: BSD-3-Clause
"""What the sensors of hector_gazebo_plugins that look at a link have in common."""

from __future__ import annotations

from bubblesim.gazebo_plugins.device import Device, PluginContext
from bubblesim.gazebo_plugins.rate import Rate
from bubblesim.gazebo_plugins.sensors.noise import Noise


class HectorSensor(Device):
    """Parameters and defaults are hector's; offsets and drifts are left out."""

    default_rate = 0.0  # Hz; 0: in each step

    def __init__(self, context: PluginContext) -> None:
        """Read the parameters that all have."""
        super().__init__(context)
        p = self.parameters
        self.enter_namespace()
        self._link = self.link("bodyName", self.world.name(self.first_link()))
        self._frame = p.text("frameId", self.world.name(self._link))
        self._noise = Noise(self, *p.deviations("gaussianNoise"))
        p.ignore("offset", "drift", "driftFrequency")
        self._rate = Rate(p.number("updateRate", self.default_rate, least=0.0), self.simulation.time_step)

    def reset(self) -> None:
        """Start over."""
        self._rate.reset()
        self._noise.reset()

    def is_due(self, *publishers: int) -> bool:
        """Whether it is time to tell, and somebody hears one of the topics."""
        return any(map(self.wanted, publishers)) and self._rate.due(self.simulation.time)
