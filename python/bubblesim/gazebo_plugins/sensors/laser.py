# SPDX-License-Identifier: BSD-3-Clause
"""gazebo_ros_laser and gazebo_ros_gpu_laser: scans of a lidar."""

from __future__ import annotations

from bubblesim._core import read_lidar
from bubblesim._core.reading_messages import laser_scan
from bubblesim.gazebo_plugins.plugin import Plugin, PluginContext
from bubblesim.gazebo_plugins.sensors.readings import NewReadings


class Laser(Plugin):
    """Parameters and defaults are those of gazebo_ros_pkgs; ranges beyond the maximum are infinite (REP 117)."""

    def __init__(self, context: PluginContext) -> None:
        """Read the parameters."""
        super().__init__(context)
        p = self.parameters
        self.enter_namespace()
        self._frame = self.frame(p.text("frameName", "/world"))
        self._scans = NewReadings(self, read_lidar, p.number("updateRate", 0.0, least=0.0))
        p.ignore("gaussianNoise", "hokuyoMinIntensity")  # the sensor's own <noise> is used
        p.check()
        self._publisher = self.advertise(p.text("topicName", "/world"), "sensor_msgs/LaserScan", 1)

    def reset(self) -> None:
        """Reset the state."""
        self._scans.reset()

    def publish(self) -> None:
        """Publish a new scan."""
        if self.is_needed(self._publisher) and (scan := self._scans.take()):
            self.bridge.publish(self._publisher, laser_scan(self.header(self._frame), scan))
