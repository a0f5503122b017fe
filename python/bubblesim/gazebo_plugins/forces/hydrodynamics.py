# SPDX-License-Identifier: BSD-3-Clause
"""gz-sim's Hydrodynamics: the linear and quadratic drag of a link in water."""

from __future__ import annotations

from bubblesim._core import Drag
from bubblesim.gazebo_plugins.parameters import where
from bubblesim.gazebo_plugins.plugin import Message, Plugin, PluginContext

_ADDED_MASS = ("xDotU", "yDotV", "zDotW", "kDotP", "mDotQ", "nDotR")


class Hydrodynamics(Plugin):
    """The diagonal damping with gz-sim's parameters and defaults. Added mass is not simulated."""

    acts_without_ros = True

    def __init__(self, context: PluginContext) -> None:
        """Read the parameters."""
        super().__init__(context)
        p = self.parameters
        link = self.link("link_name", "")
        p.ignore("water_density")
        for name in _ADDED_MASS:
            if p.number(name, 0.0) != 0.0:
                p.hints.append(f"{where(p.plugin)}: plugin '{p.plugin.name}': <{name}>: added mass is not simulated")

        def of_axes(*names: str, default: float) -> list[float]:
            return [p.number(name, default, least=0.0) for name in names]

        def squared(*names: str) -> list[float]:
            return [p.number(f"{n}{n[-1]}", p.number(f"{n}abs{n[-1]}", 0.0, least=0.0), least=0.0) for n in names]

        coefficients = {
            "linear": of_axes("xU", "yV", "zW", default=20.0),
            "angular_linear": of_axes("kP", "mQ", "nR", default=20.0),
            "quadratic": squared("xU", "yV", "zW"),
            "angular_quadratic": squared("kP", "mQ", "nR"),
        }
        self._current = p.numbers("default_current", (0.0, 0.0, 0.0))
        namespace = p.given("namespace")
        p.check()
        self._drag = Drag(self.simulation, link, in_wind=False, **coefficients)
        context.endpoints.append(self._drag.remove)
        topic = f"/model/{namespace}/ocean_current" if namespace else "/ocean_current"
        self.subscribe(topic, "geometry_msgs/Vector3", self._flow)

    def _flow(self, message: Message) -> None:
        current = message["x"], message["y"], message["z"]
        if self.usable("current", current):
            self._drag.set_current(current)

    def reset(self) -> None:
        """Return to the default current."""
        self._drag.set_current(self._current)
