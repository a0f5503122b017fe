# SPDX-License-Identifier: BSD-3-Clause
"""gazebo_ros_laser and gazebo_ros_gpu_laser: scans of a lidar."""

from __future__ import annotations

from typing import Any

from bubblesim._core import read_lidar
from bubblesim.gazebo_plugins.plugin import Message, Plugin, PluginContext
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
            self.bridge.publish(self._publisher, {"header": self.header(self._frame), **laser_scan(scan)})


def laser_scan(scan: Any, rings: slice = slice(None)) -> Message:
    """Return a sensor_msgs/LaserScan without its header, of all rings concatenated, as in Gazebo, or of some."""
    return {
        "angle_min": scan.angle_min,
        "angle_max": scan.angle_max,
        "angle_increment": scan.angle_increment,
        "range_min": scan.min_range,
        "range_max": scan.max_range,
        "ranges": scan.ranges[rings].reshape(-1),
        "intensities": scan.intensities[rings].reshape(-1),
    }
