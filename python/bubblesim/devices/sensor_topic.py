# SPDX-License-Identifier: BSD-3-Clause
"""Sensors that say themselves, by <bubblesim:topic>, where they are published."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from bubblesim._core import CameraImage, read_sensor
from bubblesim.control.frames import vector_message
from bubblesim.devices.block_laser import cloud_of_returns, directions
from bubblesim.devices.bumper import contact_state
from bubblesim.devices.camera import image_message
from bubblesim.devices.camera_info import CameraInfo
from bubblesim.devices.device import Device, Message, Place
from bubblesim.devices.imu import imu_message
from bubblesim.devices.laser import laser_scan
from bubblesim.devices.noise import Noise


@dataclass(frozen=True)
class OwnTopic:
    """Stands where a plugin stands for other devices: there is none."""

    file: str  # the sensor's path
    line: int = 0
    name: str = "bubblesim:topic"
    filename: str = "no plugin"
    parameters: list[Any] = field(default_factory=list)


class SensorTopic(Device):
    """The type follows from the kind of sensor, and the frame is the sensor's link unless <bubblesim:frame> names one.

    A sonar gives a Range, infinite for nothing in range (REP 117); a lidar of one ring a LaserScan, of several a
    PointCloud2; a camera an Image, in metres from a depth camera, with a camera_info beside it; an IMU an Imu; a GPS
    receiver a NavSatFix; an altimeter a PointStamped, whose z is the height above its start; a magnetometer a
    MagneticField; a contact sensor a ContactsState in world axes; a force-torque sensor a WrenchStamped.
    """

    def __init__(self, place: Place) -> None:
        """Advertise the topic."""
        super().__init__(place)
        topic, frame, _ = self.world.sensor_topic(place.owner)
        self._frame = frame or self.world.name(self.world.parent(place.owner))
        self._time: float | None = None
        self._info = CameraInfo(self.parameters)
        _, reading = read_sensor(self.simulation, place.owner)
        message_type, self._message = self._form(reading)
        self._publishers = [self.advertise(topic, message_type, 1)]
        if isinstance(reading, CameraImage):
            self._publishers.append(self.advertise(_beside(topic, "camera_info"), "sensor_msgs/CameraInfo", 1))

    def reset(self) -> None:
        """Time may start again."""
        self._time = None

    def publish(self) -> None:
        """Tell a new measurement."""
        if not any(map(self.wanted, self._publishers)):
            return
        time, reading = read_sensor(self.simulation, self.place.owner)
        if time == self._time:
            return
        self._time = time
        header = self.header(self._frame)
        topic, *infos = self._publishers
        if self.wanted(topic):
            self.bridge.publish(topic, {"header": header, **self._message(reading)})
        for info in infos:
            height, width = reading.depth.shape
            message = {"header": header, **self._info.message(width, height, reading.horizontal_fov)}
            self.bridge.publish(info, message)

    def _form(self, reading: Any) -> tuple[str, Callable[[Any], Message]]:
        """The type of the message, and what makes it."""
        match type(reading).__name__:
            case "ProximityReading":
                return "sensor_msgs/Range", self._range
            case "LidarScan" if len(reading.elevations) == 1:
                return "sensor_msgs/LaserScan", laser_scan
            case "LidarScan":
                rays = directions(reading)
                return "sensor_msgs/PointCloud2", lambda scan: cloud_of_returns(scan, rays)
            case "CameraImage":
                return "sensor_msgs/Image", _picture
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
                raise ValueError(f"there is no message for a {kind}: take it out, or read it in a script")

    def _contacts(self, reading: Any) -> Message:
        link = self.world.parent(self.place.owner)
        return {"states": [contact_state(self.world, link, contact) for contact in reading.contacts]}

    def _range(self, reading: Any) -> Message:
        least, most, angle = self.world.sonar_limits(self.place.owner)
        return {
            "radiation_type": 0,  # ultrasound
            "field_of_view": 2 * angle,
            "min_range": least,
            "max_range": most,
            "range": reading.distance if reading.detected else np.inf,
        }


def _picture(image: Any) -> Message:
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


def _beside(topic: str, name: str) -> str:
    """Another topic in the namespace of one."""
    space, slash, _ = topic.rpartition("/")
    return f"{space}{slash}{name}"
