# SPDX-License-Identifier: BSD-3-Clause
"""hector_quadrotor's gazebo_ros_baro: how high a link is, as a barometer would tell it."""

from __future__ import annotations

from bubblesim.devices.device import Device, Place
from bubblesim.devices.noise import Noise
from bubblesim.devices.rate import Rate


class Baro(Device):
    """Parameters and defaults are hector's. Its Altimeter message is not known here, so that topic is not there."""

    def __init__(self, place: Place) -> None:
        """Read the parameters; heights in metres."""
        super().__init__(place)
        p = self.parameters
        self.enter_namespace()
        self._link = self.link("bodyName", self.world.name(self.first_link()))
        self._frame = p.text("frameId", self.world.name(self._link))
        self._above = p.number("elevation", 0.0)
        self._noise = Noise(self, p.number("gaussianNoise", 0.0, least=0.0))
        p.ignore("altimeterTopicName", "qnh", "offset", "drift", "driftFrequency")
        self._rate = Rate(p.number("updateRate", 0.0, least=0.0), self.simulation.time_step)
        p.check()
        self._publisher = self.advertise(p.text("topicName", "pressure_height"), "geometry_msgs/PointStamped", 1)

    def reset(self) -> None:
        """Start over."""
        self._rate.reset()
        self._noise.reset()

    def publish(self) -> None:
        """Tell the height."""
        if self.wanted(self._publisher) and self._rate.due(self.simulation.time):
            (height,) = self._noise.on([self.world.pose(self._link)[2] + self._above])
            self.bridge.publish(self._publisher, {"header": self.header(self._frame), "point": {"z": height}})
