# SPDX-License-Identifier: BSD-3-Clause
"""gz-sim's VelocityControl: a model, and links of it, that have the velocity of a Twist."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from bubblesim._core import SpatialDrive
from bubblesim.gazebo_plugins.plugin import Message, Plugin, PluginContext


class GzVelocityControl(Plugin):
    """The velocity is along the axes of the model, or of the link; the model stands still until the first Twist."""

    acts_without_ros = True

    def __init__(self, context: PluginContext) -> None:
        """Read the parameters."""
        super().__init__(context)
        p = self.parameters
        model = self.world.name(context.model)
        self._first = p.numbers("initial_linear", (0.0,) * 3), p.numbers("initial_angular", (0.0,) * 3)
        links = {name: self.part_named(name, "link_name", "link") for name in p.names("link_name")}
        topic = p.text("topic", f"/model/{model}/cmd_vel")
        p.check()
        self._drive = self._drive_of(context.model)
        self.subscribe(topic, "geometry_msgs/Twist", self._commands(self._drive))
        for name, link in links.items():
            command = self._commands(self._drive_of(link))
            self.subscribe(f"/model/{model}/link/{name}/cmd_vel", "geometry_msgs/Twist", command)

    def _drive_of(self, part: int) -> Any:
        drive = SpatialDrive(self.simulation, part)
        self.context.endpoints.append(drive.remove)
        return drive

    def _commands(self, drive: Any) -> Callable[[Message], None]:
        def command(twist: Message) -> None:
            linear, angular = ([twist[part][axis] for axis in "xyz"] for part in ("linear", "angular"))
            if self.usable("Twist", (*linear, *angular)):
                drive.set_velocity(linear, angular)

        return command

    def reset(self) -> None:
        """Return to the initial velocity of the model; links are free again."""
        self._drive.set_velocity(*self._first)
