# SPDX-License-Identifier: BSD-3-Clause
"""Common parts of the hector_gazebo_plugins that measure a link."""

from __future__ import annotations

from bubblesim.gazebo_plugins.plugin import Plugin, PluginContext
from bubblesim.gazebo_plugins.rate import Rate
from bubblesim.gazebo_plugins.sensors.noise import Noise


class HectorSensor(Plugin):
    """Parameters and defaults are hector's; offsets and drifts are ignored."""

    default_rate = 0.0  # Hz; 0: every step

    def __init__(self, context: PluginContext) -> None:
        """Read the common parameters."""
        super().__init__(context)
        p = self.parameters
        self.enter_namespace()
        self._link = self.link("bodyName", self.world.name(self.first_link()))
        self._frame = p.text("frameId", self.world.name(self._link))
        self._noise = Noise(self, *p.deviations("gaussianNoise"))
        p.ignore("offset", "drift", "driftFrequency")
        self._rate = Rate(p.number("updateRate", self.default_rate, least=0.0), self.simulation)

    def reset(self) -> None:
        """Reset rate and noise."""
        self._rate.reset()
        self._noise.reset()

    def is_due(self, *publishers: int) -> bool:
        """Return whether publishing is due and a topic has subscribers."""
        return any(map(self.is_needed, publishers)) and self._rate.due()
