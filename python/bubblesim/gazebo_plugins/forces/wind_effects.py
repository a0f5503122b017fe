# SPDX-License-Identifier: BSD-3-Clause
"""WindEffects of gz-sim and WindPlugin of Gazebo: how the wind varies, and how strongly it pushes links."""

from __future__ import annotations

import math
import re

from bubblesim.gazebo_plugins.plugin import Message, Plugin, PluginContext


class WindEffects(Plugin):
    """Parameters and defaults are those of gz-sim. A geometry_msgs/Vector3 on /world/WORLD/wind sets the mean wind."""

    acts_without_ros = True
    of_world = True

    def __init__(self, context: PluginContext) -> None:
        """Read the parameters."""
        super().__init__(context)
        p = self.parameters
        positive = math.ulp(0.0)
        horizontal, vertical = p.inner("horizontal"), p.inner("vertical")
        magnitude, direction = horizontal.inner("magnitude"), horizontal.inner("direction")
        variation = {
            "rise_time": magnitude.number("time_for_rise", 1.0, least=positive),
            "sine_part": magnitude.inner("sin").number("amplitude_percent", 0.0),
            "sine_period": magnitude.inner("sin").number("period", 1.0, least=positive),
            "speed_noise": magnitude.inner("noise").number("stddev", 0.0, least=0.0),
            "turn_time": direction.number("time_for_rise", 1.0, least=positive),
            "turn_sine": math.radians(direction.inner("sin").number("amplitude", 0.0)),
            "turn_period": direction.inner("sin").number("period", 1.0, least=positive),
            "turn_noise": math.radians(direction.inner("noise").number("stddev", 0.0, least=0.0)),
            "vertical_rise_time": vertical.number("time_for_rise", 1.0, least=positive),
            "vertical_noise": vertical.inner("noise").number("stddev", 0.0, least=0.0),
        }
        factor = p.number("force_approximation_scaling_factor", 1.0, least=0.0)
        p.check()
        self._wind = self.simulation.wind
        self._wind.vary(**variation)
        self._wind.force_factor = factor
        world = re.sub(r"[^A-Za-z0-9_]", "_", self.simulation.world_name)
        self.subscribe(f"/world/{world}/wind", "geometry_msgs/Vector3", self._blow)

    def _blow(self, message: Message) -> None:
        mean = message["x"], message["y"], message["z"]
        if self.usable("wind", mean):
            self._wind.mean = mean
