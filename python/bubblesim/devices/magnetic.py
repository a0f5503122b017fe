# SPDX-License-Identifier: BSD-3-Clause
"""hector_gazebo_plugins' gazebo_ros_magnetic: the magnetic field of the Earth as a link feels it."""

from __future__ import annotations

import math

from bubblesim.control.frames import into, vector_message
from bubblesim.devices.device import Device, Place
from bubblesim.devices.noise import Noise
from bubblesim.devices.rate import Rate


class Magnetic(Device):
    """Parameters and defaults are hector's: the field is told by its magnitude, inclination and declination (degrees).

    With <useMagneticFieldMsgs> the message is a sensor_msgs/MagneticField, else a geometry_msgs/Vector3Stamped.
    """

    def __init__(self, place: Place) -> None:
        """Read the parameters."""
        super().__init__(place)
        p = self.parameters
        self.enter_namespace()
        self._link = self.link("bodyName", self.world.name(self.first_link()))
        self._frame = p.text("frameId", self.world.name(self._link))
        magnitude = p.number("magnitude", 1.0)
        inclination = math.radians(p.number("inclination", 60.0))
        heading = math.radians(p.number("referenceHeading", 0.0) - p.number("declination", 0.0))
        level = magnitude * math.cos(inclination)
        self._field = [level * math.cos(heading), level * math.sin(heading), -magnitude * math.sin(inclination)]
        self._noise = Noise(self, p.number("gaussianNoise", 0.0, least=0.0))
        p.ignore("offset", "drift", "driftFrequency")
        self._rate = Rate(p.number("updateRate", 0.0, least=0.0), self.simulation.time_step)
        self._as_field = p.flag("useMagneticFieldMsgs", default=False)
        p.check()
        message_type = "sensor_msgs/MagneticField" if self._as_field else "geometry_msgs/Vector3Stamped"
        self._publisher = self.advertise(p.text("topicName", "magnetic"), message_type, 1)

    def reset(self) -> None:
        """Start over."""
        self._rate.reset()
        self._noise.reset()

    def publish(self) -> None:
        """Tell the field in the link's frame."""
        if not (self.wanted(self._publisher) and self._rate.due(self.simulation.time)):
            return
        felt = vector_message(self._noise.on(into(self.world.pose(self._link), self._field)))
        told = {"magnetic_field": felt} if self._as_field else {"vector": felt}
        self.bridge.publish(self._publisher, {"header": self.header(self._frame), **told})
