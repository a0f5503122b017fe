# SPDX-License-Identifier: BSD-3-Clause
"""gazebo_ros_p3d: the true pose and velocity of a link."""

from __future__ import annotations

from bubblesim._core.reading_messages import odometry
from bubblesim.gazebo_plugins.plugin import Plugin, PluginContext
from bubblesim.gazebo_plugins.rate import Rate
from bubblesim.gazebo_plugins.sensors.noise import Noise
from bubblesim.geometry.frames import state_in
from bubblesim.geometry.rotations import product, quaternion_of_rpy

_WORLD = ("/world", "world", "/map", "map", "")


class P3D(Plugin):
    """Parameters and defaults are those of gazebo_ros_pkgs."""

    def __init__(self, context: PluginContext) -> None:
        """Read the parameters."""
        super().__init__(context)
        p = self.parameters
        self.enter_namespace()
        self._link = self.link("bodyName", "")
        self._frame = p.text("frameName", "world")
        self._reference = None if self._frame in _WORLD else self.link("frameName", "")
        self._offset = p.numbers("xyzOffset", p.numbers("xyzOffsets", (0.0, 0.0, 0.0)))
        self._turn = quaternion_of_rpy(p.numbers("rpyOffset", p.numbers("rpyOffsets", (0.0, 0.0, 0.0))))
        self._noise = Noise(self, *p.deviations("gaussianNoise"))
        self._rate = Rate(p.number("updateRate", 0.0, least=0.0), self.simulation)
        p.check()
        self._publisher = self.advertise(p.text("topicName", "odom"), "nav_msgs/Odometry", 1)

    def reset(self) -> None:
        """Reset rate and noise."""
        self._rate.reset()
        self._noise.reset()

    def publish(self) -> None:
        """Publish pose and velocity; the velocity is along the axes of the frame."""
        if not (self.is_needed(self._publisher) and self._rate.due()):
            return
        pose, linear, angular = state_in(self.world, self._link, self._reference)
        position = [at + offset for at, offset in zip(pose[:3], self._offset, strict=True)]
        placed = [*position, *product(self._turn, pose[3:])]
        velocity = self._noise.on(linear), self._noise.on(angular)
        variances = self._noise.variances(6)
        frames = self.header(self._frame.lstrip("/")), self.world.name(self._link)
        self.bridge.publish(self._publisher, odometry(*frames, placed, *velocity, variances, variances))
