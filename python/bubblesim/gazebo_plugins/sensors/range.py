# SPDX-License-Identifier: BSD-3-Clause
"""gazebo_ros_range and hector's sonar: the shortest range of a lidar's rays."""

from __future__ import annotations

from typing import Any

from bubblesim._core import read_lidar
from bubblesim._core.reading_messages import nearest_range
from bubblesim._core.reading_messages import range as range_message
from bubblesim.gazebo_plugins.plugin import Plugin, PluginContext
from bubblesim.gazebo_plugins.sensors.noise import Noise
from bubblesim.gazebo_plugins.sensors.readings import NewReadings

_RADIATIONS = {"ultrasound": 0, "infrared": 1}  # sensor_msgs/Range


class Range(Plugin):
    """Parameters and defaults are those of gazebo_ros_pkgs; without a return, the range is the maximum range."""

    frame_parameter = "frameName"
    default_frame = "world"
    default_topic = "/range"
    default_fov: float | None = 0.05  # rad; None for the angle between the outer rays

    def __init__(self, context: PluginContext) -> None:
        """Read the parameters."""
        super().__init__(context)
        p = self.parameters
        self.enter_namespace()
        self._frame = p.text(self.frame_parameter, self.default_frame).lstrip("/")
        self._radiation = p.choice("radiation", "ultrasound", _RADIATIONS)
        self._fov = self.default_fov if p.given("fov") is None else p.number("fov", 0.0, least=0.0)
        self._noise = Noise(self, *p.deviations("gaussianNoise"))
        self._scans = NewReadings(self, read_lidar, p.number("updateRate", 0.0, least=0.0))
        p.check()
        self._publisher = self.advertise(p.text("topicName", self.default_topic), "sensor_msgs/Range", 1)

    def reset(self) -> None:
        """Reset readings and noise."""
        self._scans.reset()
        self._noise.reset()

    def publish(self) -> None:
        """Publish a new range."""
        if self.is_needed(self._publisher) and (scan := self._scans.take()):
            fov = scan.angle_max - scan.angle_min if self._fov is None else self._fov
            limits = scan.min_range, scan.max_range
            message = range_message(self.header(self._frame), self._radiation, fov, *limits, self._nearest(scan))
            self.bridge.publish(self._publisher, message)

    def _nearest(self, scan: Any) -> float:
        nearest: float = nearest_range(scan)
        if nearest < scan.max_range:
            nearest = max(self._noise.on([nearest])[0], scan.min_range)
        return min(nearest, float(scan.max_range))


class HectorSonar(Range):
    """hector_gazebo_plugins' gazebo_ros_sonar."""

    frame_parameter = "frameId"
    default_frame = "sonar_link"
    default_topic = "sonar"
    default_fov = None

    def __init__(self, context: PluginContext) -> None:
        """Read the parameters."""
        super().__init__(context)
        self.parameters.ignore("offset", "drift", "driftFrequency")
