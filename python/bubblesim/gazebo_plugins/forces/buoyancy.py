# SPDX-License-Identifier: BSD-3-Clause
"""Buoyancy of gz-sim, for a world, and of Gazebo, for a model."""

from __future__ import annotations

from bubblesim import _core
from bubblesim.gazebo_plugins.parameters import Parameters
from bubblesim.gazebo_plugins.plugin import Plugin, PluginContext


class GzBuoyancy(Plugin):
    """gz-sim's Buoyancy: one fluid everywhere, or fluids in layers, for all models or those in <enable>."""

    acts_without_ros = True
    of_world = True

    def __init__(self, context: PluginContext) -> None:
        """Read the parameters."""
        super().__init__(context)
        p = self.parameters
        graded = p.inner("graded_buoyancy")
        uniform = p.number("uniform_fluid_density", 1000.0, least=0.0)
        density = graded.number("default_density", uniform, least=0.0)
        layers = {
            change.number("above_depth", 0.0): change.number("density", 0.0, least=0.0)
            for change in graded.all_of("density_change")
        }
        paths = ["/" + name.replace("::", "/") for name in p.names("enable")]
        p.check()
        buoyancy = _core.Buoyancy(self.simulation, density, layers=sorted(layers.items()), paths=paths)
        context.endpoints.append(buoyancy.remove)


class ModelBuoyancy(Plugin):
    """Gazebo's BuoyancyPlugin: a model in one fluid. <link> replaces the volume of the collision shapes."""

    acts_without_ros = True

    def __init__(self, context: PluginContext) -> None:
        """Read the parameters."""
        super().__init__(context)
        p = self.parameters
        density = p.number("fluid_density", 999.1026, least=0.0)
        volumes = [self._volume(link) for link in p.all_of("link")]
        p.check()
        buoyancy = _core.Buoyancy(self.simulation, density, paths=[self.world.path(context.model)])
        context.endpoints.append(buoyancy.remove)
        for volume in volumes:
            buoyancy.set_volume(*volume)

    def _volume(self, link: Parameters) -> tuple[int, float, tuple[float, ...]]:
        handle = self.part_named(link.text("name", ""), "link", "link")
        if link.given("volume") is None or link.given("center_of_volume") is None:
            raise link.fail("link", "needs <volume> and <center_of_volume>")
        return handle, link.length("volume", 1.0), link.numbers("center_of_volume", (0.0, 0.0, 0.0))
