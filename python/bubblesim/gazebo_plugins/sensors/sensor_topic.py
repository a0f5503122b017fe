# SPDX-License-Identifier: BSD-3-Clause
"""Sensors published without a plugin, by their <bubblesim:topic>."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from dataclasses import dataclass, field
from typing import Any

from bubblesim._core import CameraImage, camera_optics, read_sensor
from bubblesim._core.reading_messages import (
    color_image,
    contacts_state,
    depth_image,
    fluid_pressure,
    imu,
    laser_scan,
    lidar_cloud,
    magnetic_field,
    nav_sat_fix,
    point,
    wrench,
)
from bubblesim._core.reading_messages import range as range_message
from bubblesim.gazebo_plugins.plugin import Plugin, PluginContext
from bubblesim.gazebo_plugins.sensors.camera_info import CameraInfo
from bubblesim.gazebo_plugins.sensors.readings import is_new
from bubblesim.geometry.poses import multiply

OPTICAL = (0.0, 0.0, 0.0, -0.5, 0.5, -0.5, 0.5)  # of a camera that looks along x: z forward, x right, y down
_ULTRASOUND = 0  # sensor_msgs/Range
MakeMessage = Callable[[Any, Any], Any]  # of a header and a reading


@dataclass(frozen=True)
class NoPlugin:
    """Replaces the plugin description of a sensor without a plugin."""

    file: str  # the sensor's path
    name: str = "bubblesim:topic"
    line: int = 0
    filename: str = ""
    parameters: list[Any] = field(default_factory=list)


class SensorTopic(Plugin):
    """The message type depends on the sensor type; the frame is the sensor's link unless <bubblesim:frame> is given.

    Such a frame, unless it is a link, is published as a fixed one in that of the link: the sensor's pose, for a camera
    its optical frame, z forward and x to the right (REP 103).

    A sonar publishes a Range, infinite without an echo (REP 117); a lidar of one ring a LaserScan, of several a
    PointCloud2; a camera an Image (a depth camera in metres) and a camera_info; an IMU an Imu; a GPS receiver a
    NavSatFix; an altimeter a PointStamped, whose z is the height above its start; a magnetometer a MagneticField; a
    barometer a FluidPressure; a logical camera a ModelStates with poses in its own frame; a contact sensor a
    ContactsState in world axes; a force-torque sensor a WrenchStamped.
    """

    def __init__(self, context: PluginContext) -> None:
        """Advertise the topics."""
        super().__init__(context)
        self._topic, self._frame = self.place_of_topic()
        self._publish_own_frame()
        self._info = CameraInfo(self.parameters)
        _, reading = read_sensor(self.simulation, context.owner)
        self._outputs = [
            (self.advertise(topic, message_type, 1), message)
            for topic, message_type, message in self.outputs(self._topic, reading)
        ]

    def place_of_topic(self) -> tuple[str, str]:
        """Return the sensor's topic and frame."""
        topic, frame, _ = self.world.sensor_topic(self.context.owner)
        return topic, frame or self.world.name(self.world.carrier(self.context.owner))

    def _publish_own_frame(self) -> None:
        own = self.world.sensor_topic(self.context.owner)[1]
        links = {self.world.name(link) for link in self.world.parts(self.context.model, "link")}
        if not own or own in links:
            return
        link = self.world.carrier(self.context.owner)
        pose = self.world.pose_in(self.context.owner, link)
        if isinstance(read_sensor(self.simulation, self.context.owner)[1], CameraImage):
            pose = multiply(pose, OPTICAL)
        self.context.transforms.fix(self.header(self.world.name(link)), own, pose)
        self.context.endpoints.append(lambda: self.context.transforms.release(own))

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
            self.bridge.publish(publisher, message(header, reading))

    def _optics(self, header: Any, _: Any) -> Any:
        return self._info.message(header, *camera_optics(self.simulation, self.context.owner))

    def form(self, reading: Any) -> tuple[str, MakeMessage]:
        """Return the message type and the function that creates the message."""
        match type(reading).__name__:
            case "ProximityReading":
                return "sensor_msgs/Range", self._range
            case "LidarScan" if len(reading.elevations) == 1:
                return "sensor_msgs/LaserScan", laser_scan
            case "LidarScan":
                return "sensor_msgs/PointCloud2", lidar_cloud
            case "CameraImage":
                return "sensor_msgs/Image", depth_image if reading.rgb is None else color_image
            case "ImuReading":
                return "sensor_msgs/Imu", imu
            case "NavSatReading":
                return "sensor_msgs/NavSatFix", _fix
            case "AltimeterReading":
                return "geometry_msgs/PointStamped", lambda header, reading: point(header, (0.0, 0.0, reading.height))
            case "MagnetometerReading":
                return "sensor_msgs/MagneticField", lambda header, reading: magnetic_field(header, reading.field)
            case "AirPressureReading":
                return "sensor_msgs/FluidPressure", lambda header, reading: fluid_pressure(header, reading.pressure)
            case "LogicalCameraReading":
                return "gazebo_msgs/ModelStates", _model_states
            case "ContactReading":
                return "gazebo_msgs/ContactsState", self._contacts
            case "ForceTorqueReading":
                return "geometry_msgs/WrenchStamped", wrench
            case kind:
                raise ValueError(f"a {kind} cannot be published: remove the topic, or read the sensor in a script")

    def _contacts(self, header: Any, reading: Any) -> Any:
        return contacts_state(self.world, header, self.world.carrier(self.context.owner), reading)

    def _range(self, header: Any, reading: Any) -> Any:
        least, most, angle = self.world.sonar_limits(self.context.owner)
        return range_message(
            header, _ULTRASOUND, 2 * angle, least, most, reading.distance if reading.detected else math.inf
        )


def _model_states(_: Any, reading: Any) -> dict[str, Any]:
    """Return the poses in the frame of the camera; velocities are not measured."""
    still = {part: dict.fromkeys("xyz", 0.0) for part in ("linear", "angular")}
    poses = [
        {
            "position": dict(zip("xyz", map(float, seen.position), strict=True)),
            "orientation": dict(zip("xyzw", map(float, seen.orientation), strict=True)),
        }
        for seen in reading.models
    ]
    return {"name": [seen.name for seen in reading.models], "pose": poses, "twist": [still] * len(poses)}


def _fix(header: Any, reading: Any) -> Any:
    return nav_sat_fix(header, reading.latitude, reading.longitude, reading.altitude)


def sibling_topic(topic: str, name: str) -> str:
    """Return another topic in the namespace of a topic."""
    space, slash, _ = topic.rpartition("/")
    return f"{space}{slash}{name}"
