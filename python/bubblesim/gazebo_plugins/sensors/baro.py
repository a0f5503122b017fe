# SPDX-License-Identifier: BSD-3-Clause
"""hector_quadrotor's gazebo_ros_baro: the height of a link as measured by a barometer."""

from __future__ import annotations

from bubblesim._core.reading_messages import point
from bubblesim.gazebo_plugins.plugin import PluginContext
from bubblesim.gazebo_plugins.sensors.hector import HectorSensor


class Baro(HectorSensor):
    """Parameters and defaults are hector's. Its Altimeter message is not available, so that topic is not published."""

    def __init__(self, context: PluginContext) -> None:
        """Read the parameters; heights in metres."""
        super().__init__(context)
        p = self.parameters
        self._above = p.number("elevation", 0.0)
        p.ignore("altimeterTopicName", "qnh")
        p.check()
        self._publisher = self.advertise(p.text("topicName", "pressure_height"), "geometry_msgs/PointStamped", 1)

    def publish(self) -> None:
        """Publish the height."""
        if self.is_due(self._publisher):
            (height,) = self._noise.on([self.world.pose(self._link)[2] + self._above])
            self.bridge.publish(self._publisher, point(self.header(self._frame), (0.0, 0.0, height)))
