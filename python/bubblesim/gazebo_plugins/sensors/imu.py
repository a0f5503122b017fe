# SPDX-License-Identifier: BSD-3-Clause
"""gazebo_ros_imu_sensor, of an IMU sensor; gazebo_ros_imu and hector's, of a link."""

from __future__ import annotations

import math

from bubblesim._core import read_imu
from bubblesim._core.reading_messages import imu, imu_of_values
from bubblesim.gazebo_plugins.plugin import Plugin, PluginContext
from bubblesim.gazebo_plugins.rate import Rate
from bubblesim.gazebo_plugins.sensors.noise import Noise
from bubblesim.gazebo_plugins.sensors.readings import NewReadings
from bubblesim.geometry.frames import into
from bubblesim.geometry.poses import axis_angle
from bubblesim.geometry.rotations import product, quaternion_of_rpy

_QUEUE = 100  # messages: filters integrate rates, and lose a turn with each one that is dropped
_LONGEST = 1.0  # s between messages over which a turn is divided


class ImuSensor(Plugin):
    """Parameters and defaults are those of gazebo_ros_pkgs; this noise is added to that of the sensor."""

    def __init__(self, context: PluginContext) -> None:
        """Read the parameters."""
        super().__init__(context)
        p = self.parameters
        self.enter_namespace(of_model=True)
        if p.given("frameName") is None:
            raise p.fail("frameName", "is missing: it names the frame of the messages")
        self._frame = p.text("frameName", "")
        self._turn = quaternion_of_rpy(p.numbers("rpyOffset", (0.0, 0.0, 0.0)))
        p.ignore("xyzOffset", "bodyName", "initialOrientationAsReference")
        self._noise = Noise(self, *p.deviations("gaussianNoise"))
        self._variances = self._noise.variances(3)
        self._readings = NewReadings(self, read_imu, p.number("updateRateHZ", p.number("updateRate", 1.0)))
        p.check()
        self._publisher = self.advertise(p.text("topicName", "imu_data"), "sensor_msgs/Imu", _QUEUE)

    def reset(self) -> None:
        """Reset readings and noise."""
        self._readings.reset()
        self._noise.reset()

    def publish(self) -> None:
        """Publish a new reading."""
        if not (self.is_needed(self._publisher) and (reading := self._readings.take())):
            return
        changes = self._turn, self._noise.draw(6)
        message = imu(self.header(self._frame), reading, self._variances, self._variances, *changes)
        self.bridge.publish(self._publisher, message)


class LinkImu(Plugin):
    """Parameters and defaults are those of gazebo_ros_pkgs; measurements follow REP 145: g upwards at rest."""

    frame_parameter = "frameName"
    default_topic = "/default_imu"
    default_service = "/default_imu"

    def __init__(self, context: PluginContext) -> None:
        """Read the parameters."""
        super().__init__(context)
        p = self.parameters
        self.enter_namespace()
        self._link = self.link("bodyName", self.default_body())
        self._frame = p.text(self.frame_parameter, self.world.name(self._link))
        self._turn = quaternion_of_rpy(p.numbers("rpyOffset", (0.0, 0.0, 0.0)))
        p.ignore("xyzOffset", "imu")
        noise = Noise(self, *p.deviations("gaussianNoise"))
        self.noises = noise, noise  # of angular velocity and acceleration
        self._rate = Rate(p.number("updateRate", 0.0, least=0.0), self.simulation)
        service = self.topic(p.text("serviceName", self.default_service))
        p.check()
        self._publisher = self.advertise(p.text("topicName", self.default_topic), "sensor_msgs/Imu", _QUEUE)
        self.advertise_service(service, "std_srvs/Empty", lambda _: None)  # calibration, in other drivers

    def default_body(self) -> str:
        """Return the default of <bodyName>; none, because it is required."""
        return ""

    def reset(self) -> None:
        """Reset rate and noise."""
        self._rate.reset()
        for noise in self.noises:
            noise.reset()

    def publish(self) -> None:
        """Publish the motion of the link."""
        if not (self.is_needed(self._publisher) and self._rate.due()):
            return
        pose = self.world.pose(self._link)
        pose[3:] = product(self._turn, pose[3:])
        force = [a - g for a, g in zip(self.world.acceleration(self._link), self.world.gravity, strict=True)]
        noises = self.noises
        values = pose[3:], noises[0].on(self.rate_of_turn(pose)), noises[1].on(into(pose, force))
        variances = (noise.variances(3) for noise in noises)
        self.bridge.publish(self._publisher, imu_of_values(self.header(self._frame), *values, *variances))

    def rate_of_turn(self, pose: list[float]) -> list[float]:
        """Return the angular velocity in the axes of a pose of the link, rad/s."""
        _, angular = self.world.velocity(self._link)
        return list(into(pose, angular))


class HectorImu(LinkImu):
    """hector_gazebo_plugins' gazebo_ros_imu; offsets, drifts and the noise of the heading are ignored.

    As there, the angular velocity is the turn since the last message: a robot that a program turns measures it.
    """

    frame_parameter = "frameId"
    default_topic = "imu"
    default_service = "imu/calibrate"

    def __init__(self, context: PluginContext) -> None:
        """Read the parameters."""
        super().__init__(context)
        for kind in ("accel", "rate", "heading", "yaw"):
            self.parameters.ignore(*(f"{kind}{what}" for what in ("Offset", "Drift", "DriftFrequency")))
        self.parameters.ignore("biasTopicName", "headingGaussianNoise", "yawGaussianNoise")
        self.noises = self._noise("rateGaussianNoise"), self._noise("accelGaussianNoise")
        self.parameters.check()
        self._before: list[float] = []  # orientation of the last message
        self._last_time = -math.inf  # s

    def reset(self) -> None:
        """Forget the last message, too."""
        super().reset()
        self._last_time = -math.inf

    def rate_of_turn(self, pose: list[float]) -> list[float]:
        """Return the mean since the last message; without one in the last second, the present angular velocity."""
        time = self.simulation.state_time
        step = time - self._last_time
        before, self._before, self._last_time = self._before, list(pose[3:]), time
        if not 0.0 < step <= _LONGEST:
            return super().rate_of_turn(pose)
        back = [*(-part for part in before[:3]), before[3]]
        axis, angle = axis_angle(product(back, pose[3:]))
        return [part * angle / step for part in axis]

    def default_body(self) -> str:
        """Return the model's first link."""
        return str(self.world.name(self.first_link()))

    def _noise(self, parameter: str) -> Noise:
        """Return the noise of one deviation, or of one per axis."""
        return Noise(self, *self.parameters.deviations(parameter))
