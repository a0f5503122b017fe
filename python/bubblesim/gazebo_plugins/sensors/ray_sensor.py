# SPDX-License-Identifier: BSD-3-Clause
"""gazebo_ros_ray_sensor of ROS 2: a lidar as a scan or as a point cloud."""

from __future__ import annotations

from bubblesim._core import read_lidar
from bubblesim._core.reading_messages import laser_scan, lidar_cloud
from bubblesim.gazebo_plugins.plugin import Plugin, PluginContext
from bubblesim.gazebo_plugins.sensors.readings import NewReadings

_OUTPUTS = {"sensor_msgs/PointCloud2": lidar_cloud, "sensor_msgs/LaserScan": laser_scan}
_OUT = "~/out:="


class RaySensor(Plugin):
    """Topic: PLUGIN/out, or TOPIC of <ros><remapping>~/out:=TOPIC</remapping></ros>; frame: that of the link."""

    def __init__(self, context: PluginContext) -> None:
        """Read the parameters."""
        super().__init__(context)
        p = self.parameters
        self.enter_namespace()
        self._frame = p.text("frameName", self.world.name(self.world.carrier(context.owner)))
        message_type = p.text("outputType", "sensor_msgs/PointCloud2")
        if message_type not in _OUTPUTS:
            raise p.fail("outputType", f"is '{message_type}', it must be {' or '.join(_OUTPUTS)}")
        self._form = _OUTPUTS[message_type]
        p.ignore("minIntensity", "radiationType")
        remapping = p.child("ros", "remapping") or ""
        topic = remapping.removeprefix(_OUT) if remapping.startswith(_OUT) else f"{p.plugin.name}/out"
        self._scans = NewReadings(self, read_lidar)
        p.check()
        self._publisher = self.advertise(topic, message_type, 1)

    def reset(self) -> None:
        """Reset the state."""
        self._scans.reset()

    def publish(self) -> None:
        """Publish a new scan."""
        if self.is_needed(self._publisher) and (scan := self._scans.take()):
            self.bridge.publish(self._publisher, self._form(self.header(self._frame), scan))
