# SPDX-License-Identifier: BSD-3-Clause
"""gazebo_ros_bumper: contacts of a contact sensor's link."""

from __future__ import annotations

from bubblesim._core import read_sensor
from bubblesim._core.reading_messages import contacts_state
from bubblesim.gazebo_plugins.plugin import Plugin, PluginContext
from bubblesim.gazebo_plugins.sensors.readings import NewReadings

_WORLD = ("/world", "world", "/map", "map")


class Bumper(Plugin):
    """Parameters and defaults are those of gazebo_ros_pkgs; positions and forces are in the frame of a link."""

    def __init__(self, context: PluginContext) -> None:
        """Read the parameters."""
        super().__init__(context)
        p = self.parameters
        self.enter_namespace()
        self._frame = p.text("frameName", "world")
        self._reference = -1 if self._frame in _WORLD else self.link("frameName", "")
        self._readings = NewReadings(self, lambda *sensor: read_sensor(*sensor)[1], p.number("updateRate", 0.0))
        p.check()
        self._publisher = self.advertise(p.text("bumperTopicName", "bumper_states"), "gazebo_msgs/ContactsState", 1)

    def reset(self) -> None:
        """Reset the state."""
        self._readings.reset()

    def publish(self) -> None:
        """Publish the contacts, also if there are none."""
        if self.is_needed(self._publisher) and (reading := self._readings.take()):
            link = self.world.carrier(self.context.owner)
            header = self.header(self._frame.lstrip("/"))
            self.bridge.publish(self._publisher, contacts_state(self.world, header, link, reading, self._reference))
