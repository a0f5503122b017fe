# SPDX-License-Identifier: BSD-3-Clause
"""Lidars as point clouds: gazebo_ros_block_laser, and the Velodyne plugin."""

from __future__ import annotations

from typing import Any

import numpy as np

from bubblesim._core import read_lidar
from bubblesim.gazebo_plugins.plugin import Message, Plugin, PluginContext
from bubblesim.gazebo_plugins.sensors.readings import NewReadings

Array = np.ndarray[Any, Any]

_UINT16, _FLOAT32 = 4, 7  # sensor_msgs/PointField
_POINT = np.dtype([("x", "<f4"), ("y", "<f4"), ("z", "<f4"), ("intensity", "<f4"), ("ring", "<u2"), ("time", "<f4")])
_OFFSETS = {"x": 0, "y": 4, "z": 8, "intensity": 12, "ring": 16, "time": 18}
_FIELDS = [
    {"name": name, "offset": offset, "datatype": _UINT16 if name == "ring" else _FLOAT32, "count": 1}
    for name, offset in _OFFSETS.items()
]


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
        self._directions: Array | None = None  # unit vectors, rings x samples x 3

    def reset(self) -> None:
        """Reset the state."""
        self._scans.reset()

    def publish(self) -> None:
        """Publish a new scan."""
        if self.is_needed(self._publisher) and (scan := self._scans.take()):
            self.bridge.publish(self._publisher, {"header": self.header(self._frame), **self.cloud(scan)})

    def cloud(self, scan: Any) -> Message:
        """Return the message without its header; rays without a return end at the maximum range, as in Gazebo."""
        ranges = np.clip(scan.ranges, scan.min_range, scan.max_range)
        points = (self.directions(scan) * ranges[:, :, None]).reshape(-1, 3)
        return {"points": points, "channels": [{"name": "intensities", "values": scan.intensities.reshape(-1)}]}

    def directions(self, scan: Any) -> Array:
        """Return the directions of the rays, computed once."""
        if self._directions is None:
            self._directions = directions(scan)
        return self._directions


class VelodyneLaser(BlockLaser):
    """A sensor_msgs/PointCloud2 of the returns: x, y, z, intensity, ring and time, as in velodyne_pointcloud."""

    message_type = "sensor_msgs/PointCloud2"

    def __init__(self, context: PluginContext) -> None:
        """Read the parameters."""
        p = context.parameters
        self._min_range = p.number("min_range", 0.0, least=0.0)
        self._max_range = p.number("max_range", np.inf, least=0.0)
        self._organized = p.flag("organize_cloud", default=False)
        p.ignore("min_intensity")
        super().__init__(context)

    def cloud(self, scan: Any) -> Message:
        """Return the message without its header; in an organized cloud, rays without a return are NaN."""
        return cloud_of_returns(
            scan, self.directions(scan), self._min_range, self._max_range, organized=self._organized
        )


def cloud_of_returns(
    scan: Any, rays: Array, least: float = 0.0, most: float = np.inf, *, organized: bool = False
) -> Message:
    """Return a sensor_msgs/PointCloud2 without its header, of the returns between two ranges."""
    met = np.isfinite(scan.ranges) & (scan.ranges > least) & (scan.ranges < most)
    points = np.zeros(scan.ranges.shape, _POINT)
    places = rays * np.where(met, scan.ranges, np.float32(np.nan))[:, :, None]
    points["x"], points["y"], points["z"] = np.moveaxis(places, 2, 0)
    points["intensity"] = scan.intensities
    points["ring"] = np.arange(len(points))[:, None]
    if not organized:
        points = points[met][None, :]
    height, width = points.shape
    return {
        "height": height,
        "width": width,
        "fields": _FIELDS,
        "is_bigendian": False,
        "point_step": _POINT.itemsize,
        "row_step": _POINT.itemsize * width,
        "data": np.ascontiguousarray(points).view(np.uint8),
        "is_dense": not organized,
    }


def directions(scan: Any) -> Array:
    """Return unit vectors of a lidar's rays in its frame, rings x samples x 3 of float32."""
    across, up = scan.angles[None, :], scan.elevations[:, None]
    vectors = np.cos(up) * np.cos(across), np.cos(up) * np.sin(across), np.sin(up) * np.ones_like(across)
    rays: Array = np.stack(vectors, axis=2).astype(np.float32)
    return rays
