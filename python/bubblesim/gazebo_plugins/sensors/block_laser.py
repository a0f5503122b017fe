# SPDX-License-Identifier: BSD-3-Clause
"""Lidars as point clouds: gazebo_ros_block_laser, and the Velodyne plugin."""

from __future__ import annotations

import math
from typing import Any

from bubblesim._core import read_lidar
from bubblesim._core.reading_messages import lidar_cloud, lidar_points
from bubblesim.gazebo_plugins.plugin import Plugin, PluginContext
from bubblesim.gazebo_plugins.sensors.readings import NewReadings


class BlockLaser(Plugin):
    """A sensor_msgs/PointCloud with intensities. Parameters and defaults are those of gazebo_ros_pkgs."""

    message_type = "sensor_msgs/PointCloud"

    def __init__(self, context: PluginContext) -> None:
        """Read the parameters."""
        super().__init__(context)
        p = self.parameters
        self.enter_namespace()
        self._frame = p.text("frameName", "world").lstrip("/")
        self._scans = NewReadings(self, read_lidar, p.number("updateRate", 0.0, least=0.0))
        p.ignore("gaussianNoise", "hokuyoMinIntensity")  # the sensor's own <noise> is used
        p.check()
        self._publisher = self.advertise(p.text("topicName", "/world"), self.message_type, 1)

    def reset(self) -> None:
        """Reset the state."""
        self._scans.reset()

    def publish(self) -> None:
        """Publish a new scan."""
        if self.is_needed(self._publisher) and (scan := self._scans.take()):
            self.bridge.publish(self._publisher, self.cloud(self.header(self._frame), scan))

    def cloud(self, header: Any, scan: Any) -> Any:
        """Return the message; rays without a return end at the maximum range, as in Gazebo."""
        return lidar_points(header, scan)


class VelodyneLaser(BlockLaser):
    """A sensor_msgs/PointCloud2 of the returns: x, y, z, intensity, ring and time, as in velodyne_pointcloud."""

    message_type = "sensor_msgs/PointCloud2"

    def __init__(self, context: PluginContext) -> None:
        """Read the parameters."""
        p = context.parameters
        self._min_range = p.number("min_range", 0.0, least=0.0)
        self._max_range = p.number("max_range", math.inf, least=0.0)
        self._organized = p.flag("organize_cloud", default=False)
        p.ignore("min_intensity")
        super().__init__(context)

    def cloud(self, header: Any, scan: Any) -> Any:
        """Return the message; in an organized cloud, rays without a return are NaN."""
        return lidar_cloud(header, scan, self._min_range, self._max_range, self._organized)
