# SPDX-License-Identifier: BSD-3-Clause
"""Sensors published as by gz-sim and ros_gz_bridge: names are gz-sim's, types are ROS's."""

from __future__ import annotations

import math
import re
from collections.abc import Collection, Iterator
from typing import Any

from bubblesim._core.reading_messages import camera_cloud, color_image, depth_image, laser_scan, lidar_cloud
from bubblesim.gazebo_plugins.plugin import PluginContext
from bubblesim.gazebo_plugins.sensors.sensor_topic import MakeMessage, SensorTopic, sibling_topic

# By SDFormat's sensor type: the system that publishes it, and the last part of its default topic.
_SERVED = {
    "lidar": ("gz-sensors-system", "scan"),
    "gpu_lidar": ("gz-sensors-system", "scan"),
    "camera": ("gz-sensors-system", "image"),
    "depth_camera": ("gz-sensors-system", "depth_image"),
    "rgbd_camera": ("gz-sensors-system", ""),
    "imu": ("gz-imu-system", "imu"),
    "navsat": ("gz-navsat-system", "navsat"),
    "gps": ("gz-navsat-system", "navsat"),
    "altimeter": ("gz-altimeter-system", "altimeter"),
    "magnetometer": ("gz-magnetometer-system", "magnetometer"),
    "air_pressure": ("gz-air-pressure-system", "air_pressure"),
    "logical_camera": ("gz-logical-camera-system", "logical_camera"),
    "contact": ("gz-contact-system", "contact"),
    "force_torque": ("gz-forcetorque-system", "forcetorque"),
}
# Sensors whose images have another format than those of cameras here.
_LEFT_OUT = ("segmentation_camera",)


def publishes_as_gz(world: Any, sensor: int, systems: Collection[str]) -> bool:
    """Return whether a sensor without a plugin has a <topic>, or a loaded gz-sim system publishes it."""
    kind, topic, _, _ = world.gz_topic(sensor)
    if topic.startswith("~") or kind in _LEFT_OUT:  # ~ is only valid in Gazebo's own transport
        return False
    return bool(topic) or (kind in _SERVED and _SERVED[kind][0] in systems)


class GzSensor(SensorTopic):
    """Topic: <topic>, or /world/WORLD/model/MODEL/link/LINK/sensor/SENSOR/...; frame: MODEL/LINK/SENSOR.

    A lidar publishes the LaserScan of its middle ring, and all points on TOPIC/points; a depth camera depths in metres
    and TOPIC/points; an rgbd_camera image, depth_image, points and camera_info below its topic. Points are in the
    sensor's axes, x forward. Other sensors publish as SensorTopic does.
    """

    def __init__(self, context: PluginContext) -> None:
        """Advertise the topics."""
        self._kind, self._given_topic, self._info_topic, self._given_frame = context.simulation.world.gz_topic(
            context.owner
        )
        super().__init__(context)

    def place_of_topic(self) -> tuple[str, str]:
        """Return the sensor's topic and frame."""
        chain = [self.world.carrier(self.context.owner), self.context.owner]
        while (model := self.world.part_of(chain[0])) >= 0:
            chain.insert(0, model)
        names = [self.world.name(part) for part in chain]
        steps = [f"{self.world.kind(part)}/{name}" for part, name in zip(chain, names, strict=True)]
        _, end = _SERVED.get(self._kind, ("", ""))
        default = "/".join(["/world", self.simulation.world_name, *steps, end])
        return _valid(self._given_topic or default), self._given_frame or "/".join(names)

    def outputs(self, topic: str, reading: Any) -> Iterator[tuple[str, str, MakeMessage]]:
        """Yield the outputs of a kind of reading: topic, type and the function that creates the message."""
        match self._kind:
            case "lidar" | "gpu_lidar":
                middle = len(reading.elevations) // 2
                yield topic, "sensor_msgs/LaserScan", lambda header, scan: laser_scan(header, scan, middle)
                yield (
                    f"{topic}/points",
                    "sensor_msgs/PointCloud2",
                    lambda header, scan: lidar_cloud(header, scan, organized=True),
                )
            case "depth_camera":
                yield topic, "sensor_msgs/Image", depth_image
                yield f"{topic}/points", "sensor_msgs/PointCloud2", _points
                yield self.info_output(self._info_topic or sibling_topic(topic, "camera_info"))
            case "rgbd_camera":
                yield f"{topic}/image", "sensor_msgs/Image", color_image
                yield f"{topic}/depth_image", "sensor_msgs/Image", depth_image
                yield f"{topic}/points", "sensor_msgs/PointCloud2", _points
                yield self.info_output(self._info_topic or f"{topic}/camera_info")
            case "camera":
                yield topic, *self.form(reading)
                yield self.info_output(self._info_topic or sibling_topic(topic, "camera_info"))
            case _:
                yield from super().outputs(topic, reading)


def _points(header: Any, image: Any) -> Any:
    return camera_cloud(header, image, (-math.inf, math.inf), optical=False)


def _valid(topic: str) -> str:
    """Return a valid, absolute ROS name: other characters allowed in Gazebo's transport become underscores."""
    return "/" + re.sub(r"[^A-Za-z0-9_/]", "_", re.sub(r"/+", "/", topic).strip("/"))
