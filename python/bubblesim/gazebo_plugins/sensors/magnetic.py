# SPDX-License-Identifier: BSD-3-Clause
"""hector_gazebo_plugins' gazebo_ros_magnetic: the Earth's magnetic field measured at a link."""

from __future__ import annotations

import math

from bubblesim._core.reading_messages import magnetic_field, vector
from bubblesim.gazebo_plugins.plugin import PluginContext
from bubblesim.gazebo_plugins.sensors.hector import HectorSensor
from bubblesim.geometry.frames import into


class Magnetic(HectorSensor):
    """Parameters and defaults are hector's: magnitude, inclination and declination (degrees) of the field.

    With <useMagneticFieldMsgs> the message is a sensor_msgs/MagneticField, else a geometry_msgs/Vector3Stamped.
    """

    def __init__(self, context: PluginContext) -> None:
        """Read the parameters."""
        super().__init__(context)
        p = self.parameters
        magnitude = p.number("magnitude", 1.0)
        inclination = math.radians(p.number("inclination", 60.0))
        heading = math.radians(p.number("referenceHeading", 0.0) - p.number("declination", 0.0))
        level = magnitude * math.cos(inclination)
        self._field = [level * math.cos(heading), level * math.sin(heading), -magnitude * math.sin(inclination)]
        as_field = p.flag("useMagneticFieldMsgs", default=False)
        p.check()
        self._message = magnetic_field if as_field else vector
        message_type = "sensor_msgs/MagneticField" if as_field else "geometry_msgs/Vector3Stamped"
        self._publisher = self.advertise(p.text("topicName", "magnetic"), message_type, 1)

    def publish(self) -> None:
        """Publish the field in the link's frame."""
        if not self.is_due(self._publisher):
            return
        measured = self._noise.on(into(self.world.pose(self._link), self._field))
        self.bridge.publish(self._publisher, self._message(self.header(self._frame), measured))
