# SPDX-License-Identifier: BSD-3-Clause
"""Sensors published without a plugin, by their <bubblesim:topic>."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from bubblesim._core import CameraImage, camera_optics, read_sensor
from bubblesim.gazebo_plugins.plugin import Message, Plugin, PluginContext
from bubblesim.gazebo_plugins.sensors.block_laser import cloud_of_returns, directions
from bubblesim.gazebo_plugins.sensors.bumper import contact_state
from bubblesim.gazebo_plugins.sensors.camera import image_message
from bubblesim.gazebo_plugins.sensors.camera_info import CameraInfo
from bubblesim.gazebo_plugins.sensors.imu import imu_message
from bubblesim.gazebo_plugins.sensors.laser import laser_scan
from bubblesim.gazebo_plugins.sensors.noise import Noise
from bubblesim.gazebo_plugins.sensors.readings import is_new
from bubblesim.ros_messages import vector_message

MakeMessage = Callable[[Any], Message]  # of a reading, without the header


@dataclass(frozen=True)
class NoPlugin:
    """Replaces the plugin description of a sensor without a plugin."""

    file: str  # the sensor's path
    name: str = "bubblesim:topic"
    line: int = 0
    filename: str = "no plugin"
    parameters: list[Any] = field(default_factory=list)


class SensorTopic(Plugin):
    """The message type depends on the sensor type; the frame is the sensor's link unless <bubblesim:frame> is given.

    A sonar publishes a Range, infinite without an echo (REP 117); a lidar of one ring a LaserScan, of several a
    PointCloud2; a camera an Image (a depth camera in metres) and a camera_info; an IMU an Imu; a GPS receiver a
    NavSatFix; an altimeter a PointStamped, whose z is the height above its start; a magnetometer a MagneticField; a
    contact sensor a ContactsState in world axes; a force-torque sensor a WrenchStamped.
    """

    def __init__(self, context: PluginContext) -> None:
        """Advertise the topics."""
        super().__init__(context)
        self._topic, self._frame = self.place_of_topic()
        self._info = CameraInfo(self.parameters)
        _, reading = read_sensor(self.simulation, context.owner)
        self._outputs = [
            (self.advertise(topic, message_type, 1), message)
            for topic, message_type, message in self.outputs(self._topic, reading)
        ]

    def place_of_topic(self) -> tuple[str, str]:
        """Return the sensor's topic and frame."""
        topic, frame, _ = self.world.sensor_topic(self.context.owner)
        return topic, frame or self.world.name(self.world.parent(self.context.owner))

    def outputs(self, topic: str, reading: Any) -> Iterator[tuple[str, str, MakeMessage]]:
        """Yield the outputs of a kind of reading: topic, type and the function that creates the message."""
        yield topic, *self.form(reading)
        if isinstance(reading, CameraImage):
            yield self.info_output(sibling_topic(topic, "camera_info"))

    def info_output(self, topic: str) -> tuple[str, str, MakeMessage]:
        """Return the camera info output."""
        return topic, "sensor_msgs/CameraInfo", self._optics

    def publish(self) -> None:
        """Publish a new measurement; subscribers of the camera info alone do not trigger one."""
        needed = [output for output in self._outputs if self.is_needed(output[0])]
        if not needed or not is_new(self.simulation, self.context.owner):
            return
        header = self.header(self._frame)
        optics_alone = all(message == self._optics for _, message in needed)
        reading = None if optics_alone else read_sensor(self.simulation, self.context.owner)[1]
        for publisher, message in needed:
            self.bridge.publish(publisher, {"header": header, **message(reading)})

    def _optics(self, _: Any) -> Message:
        return self._info.message(*camera_optics(self.simulation, self.context.owner))

    def form(self, reading: Any) -> tuple[str, MakeMessage]:
        """Return the message type and the function that creates the message."""
        match type(reading).__name__:
            case "ProximityReading":
                return "sensor_msgs/Range", self._range
            case "LidarScan" if len(reading.elevations) == 1:
                return "sensor_msgs/LaserScan", laser_scan
            case "LidarScan":
                rays = directions(reading)
                return "sensor_msgs/PointCloud2", lambda scan: cloud_of_returns(scan, rays)
            case "CameraImage":
                return "sensor_msgs/Image", picture
            case "ImuReading":
                exact = Noise(self, 0.0)
                return "sensor_msgs/Imu", lambda imu: imu_message(
                    imu.orientation.tolist(), imu.angular_velocity.tolist(), imu.linear_acceleration.tolist(), exact
                )
            case "NavSatReading":
                return "sensor_msgs/NavSatFix", _fix
            case "AltimeterReading":
                return "geometry_msgs/PointStamped", lambda reading: {"point": {"z": reading.height}}
            case "MagnetometerReading":
                return "sensor_msgs/MagneticField", lambda reading: {
                    "magnetic_field": vector_message(reading.field.tolist())
                }
            case "ContactReading":
                return "gazebo_msgs/ContactsState", self._contacts
            case "ForceTorqueReading":
                return "geometry_msgs/WrenchStamped", _wrench
            case kind:
                raise ValueError(f"a {kind} cannot be published: remove the topic, or read the sensor in a script")

    def _contacts(self, reading: Any) -> Message:
        link = self.world.parent(self.context.owner)
        return {"states": [contact_state(self.world, link, contact) for contact in reading.contacts]}

    def _range(self, reading: Any) -> Message:
        least, most, angle = self.world.sonar_limits(self.context.owner)
        return {
            "radiation_type": 0,  # ultrasound
            "field_of_view": 2 * angle,
            "min_range": least,
            "max_range": most,
            "range": reading.distance if reading.detected else np.inf,
        }


def picture(image: Any) -> Message:
    """Return a sensor_msgs/Image of colours, or of depths in metres for depth cameras."""
    return image_message(image.depth, "32FC1") if image.rgb is None else image_message(image.rgb, "rgb8")


def _fix(reading: Any) -> Message:
    return {
        "status": {"status": 0, "service": 1},  # a fix, by GPS
        "latitude": reading.latitude,
        "longitude": reading.longitude,
        "altitude": reading.altitude,
    }


def _wrench(reading: Any) -> Message:
    parts = {"force": reading.force, "torque": reading.torque}
    return {"wrench": {name: vector_message(vector.tolist()) for name, vector in parts.items()}}


def sibling_topic(topic: str, name: str) -> str:
    """Return another topic in the namespace of a topic."""
    space, slash, _ = topic.rpartition("/")
    return f"{space}{slash}{name}"
