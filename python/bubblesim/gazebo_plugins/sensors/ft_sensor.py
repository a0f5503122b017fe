# SPDX-License-Identifier: BSD-3-Clause
"""gazebo_ros_ft_sensor: force and torque in a joint."""

from __future__ import annotations

from bubblesim._core import read_sensor
from bubblesim._core.reading_messages import wrench
from bubblesim.gazebo_plugins.plugin import Plugin, PluginContext
from bubblesim.gazebo_plugins.sensors.noise import Noise
from bubblesim.gazebo_plugins.sensors.readings import NewReadings


class FtSensor(Plugin):
    """Parameters and defaults are those of gazebo_ros_pkgs; the joint must have a sensor of type force_torque."""

    def __init__(self, context: PluginContext) -> None:
        """Read the parameters."""
        super().__init__(context)
        p = self.parameters
        self.enter_namespace()
        joint = self.joint("jointName", "")
        sensors = [part for part in self.world.children(joint) if self.world.kind(part) == "sensor"]
        if not sensors:
            raise p.fail("jointName", "names a joint without a <sensor type='force_torque'>: add one to the joint")
        self._frame = self.world.name(self.world.joint_links(joint)[1])
        self._noise = Noise(self, *p.deviations("gaussianNoise"))
        rate = p.number("updateRate", 0.0, least=0.0)
        self._readings = NewReadings(self, lambda *sensor: read_sensor(*sensor)[1], rate, sensors[0])
        p.check()
        self._publisher = self.advertise(p.text("topicName", "wrench"), "geometry_msgs/WrenchStamped", 1)

    def reset(self) -> None:
        """Reset readings and noise."""
        self._readings.reset()
        self._noise.reset()

    def publish(self) -> None:
        """Publish a new reading."""
        if self.is_needed(self._publisher) and (reading := self._readings.take()):
            message = wrench(self.header(self._frame), reading, self._noise.draw(6))
            self.bridge.publish(self._publisher, message)
