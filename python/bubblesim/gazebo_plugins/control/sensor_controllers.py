# SPDX-License-Identifier: BSD-3-Clause
"""imu_sensor_controller and force_torque_sensor_controller: readings of the robot's sensors; no joint is commanded."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from bubblesim._core import read_sensor
from bubblesim._core.reading_messages import imu, wrench
from bubblesim.gazebo_plugins.control.controller import Controller, Robot
from bubblesim.gazebo_plugins.control.ros_parameters import ControllerError, ControllerParameters
from bubblesim.gazebo_plugins.sensors.readings import NewReadings


class SensorController(Controller):
    """Publishes each sensor of a kind, on a topic with the sensor's name beside the controller manager."""

    kind: str  # SDFormat's
    message_type: str
    message: Callable[..., Any]  # of a header and a reading

    def __init__(self, robot: Robot, name: str, parameters: ControllerParameters) -> None:
        """Read the parameter publish_rate, and find the sensors."""
        super().__init__(robot, name, parameters)
        plugin, world = robot.plugin, robot.plugin.world
        hertz = parameters.length("publish_rate")
        plugin.context.need_rate(hertz)
        self._outputs: list[tuple[NewReadings, str, int]] = []
        for sensor in plugin.parts_of_model():
            if world.kind(sensor) != "sensor" or world.gz_topic(sensor)[0] != self.kind:
                continue
            carrier = world.carrier(sensor)
            if world.kind(carrier) == "joint":
                carrier = world.joint_links(carrier)[1]
            readings = NewReadings(plugin, lambda *which: read_sensor(*which)[1], hertz, sensor)
            topic = f"{robot.namespace.rstrip('/')}/{world.name(sensor)}"
            self._outputs.append((readings, world.name(carrier), self.advertise(topic, self.message_type)))
        if not self._outputs:
            raise ControllerError(f"{parameters.name}: the robot has no <sensor type='{self.kind}'>")

    def reset(self) -> None:
        """Reset the rates."""
        for readings, _, _ in self._outputs:
            readings.reset()

    def publish(self) -> None:
        """Publish the new readings."""
        for readings, frame, publisher in self._outputs:
            if self.is_needed(publisher) and (reading := readings.take()):
                self.send(publisher, type(self).message(self.robot.plugin.header(frame), reading))


class ImuSensors(SensorController):
    """imu_sensor_controller/ImuSensorController."""

    kind = "imu"
    message_type = "sensor_msgs/Imu"
    message = imu


class ForceTorqueSensors(SensorController):
    """force_torque_sensor_controller/ForceTorqueSensorController."""

    kind = "force_torque"
    message_type = "geometry_msgs/WrenchStamped"
    message = wrench
