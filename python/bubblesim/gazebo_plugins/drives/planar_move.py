# SPDX-License-Identifier: BSD-3-Clause
"""gazebo_ros_planar_move: a model that follows a Twist in the plane, in any direction."""

from __future__ import annotations

from bubblesim._core import PlanarDrive
from bubblesim.gazebo_plugins.drives.odometry import Odometry, motion_in_world, variances
from bubblesim.gazebo_plugins.plugin import Message, Plugin, PluginContext
from bubblesim.gazebo_plugins.rate import Rate


class PlanarMove(Plugin):
    """Parameters, topics and defaults are those of gazebo_ros_pkgs. The model stays subject to gravity and contacts."""

    def __init__(self, context: PluginContext) -> None:
        """Read the parameters."""
        super().__init__(context)
        p = self.parameters
        self.enter_namespace()
        self._rate = Rate(p.number("odometryRate", 20.0, least=0.0), self.simulation)
        self._timeout = p.number("cmdTimeout", -1.0)  # s; negative: no timeout
        p.ignore("update_rate", "publish_rate", "publish_odom", "publish_odom_tf")
        p.check()
        self._odometry = Odometry(
            self,
            topic=p.text("odometryTopic", "odom"),
            frame=p.text("odometryFrame", "odom"),
            base_frame=p.text("robotBaseFrame", "base_footprint"),
            transform=True,
            pose_variances=variances(1e-5, 1e-5, 1e-3),
            velocity_variances=variances(1e-5, 1e-5, 1e-3),
        )
        self._drive = PlanarDrive(self.world, context.model)
        context.endpoints.append(self._drive.remove)
        self._commanded_at = 0.0  # s of simulated time
        self.subscribe(p.text("commandTopic", "cmd_vel"), "geometry_msgs/Twist", self._command)

    def _command(self, twist: Message) -> None:
        wanted = twist["linear"]["x"], twist["linear"]["y"], twist["angular"]["z"]
        if self.usable("Twist", wanted):
            self._drive.set_velocity(*wanted)
            self._commanded_at = self.simulation.time

    def reset(self) -> None:
        """Stop."""
        self._drive.set_velocity(0.0, 0.0, 0.0)
        self._commanded_at = 0.0
        self._rate.reset()

    def actuate(self) -> None:
        """Stop when the last command is too old."""
        if 0 <= self._timeout < self.simulation.time - self._commanded_at:
            self._drive.set_velocity(0.0, 0.0, 0.0)

    def publish(self) -> None:
        """Publish the odometry, which is exact."""
        if self._rate.due():
            self._odometry.publish(motion_in_world(self.world, self.context.model))
