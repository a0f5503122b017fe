# SPDX-License-Identifier: BSD-3-Clause
"""Models that follow a Twist in the plane, in any direction: gazebo_ros_planar_move, gazebo_ros_force_based_move."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from bubblesim._core import PlanarDrive, PlanarForceDrive
from bubblesim.gazebo_plugins.drives.odometry import Odometry, motion_in_world, variances
from bubblesim.gazebo_plugins.plugin import Message, Plugin, PluginContext
from bubblesim.gazebo_plugins.rate import Rate


class PlanarMove(Plugin):
    """Parameters, topics and defaults are those of gazebo_ros_pkgs. The model stays subject to gravity and contacts."""

    timeout = "cmdTimeout"
    transform: str | None = None  # a parameter that turns the transform off

    def __init__(self, context: PluginContext) -> None:
        """Read the parameters."""
        super().__init__(context)
        p = self.parameters
        self.enter_namespace()
        self._rate = Rate(p.number("odometryRate", 20.0, least=0.0), self.simulation)
        self._timeout = p.number(self.timeout, -1.0)  # s; negative: no timeout
        transform = self.transform is None or p.flag(self.transform, default=True)
        make_drive = self._read_drive()
        p.ignore("update_rate", "publish_rate", "publish_odom", "publish_odom_tf")
        p.check()
        self._odometry = Odometry(
            self,
            topic=p.text("odometryTopic", "odom"),
            frame=p.text("odometryFrame", "odom"),
            base_frame=p.text("robotBaseFrame", "base_footprint"),
            transform=transform,
            pose_variances=variances(1e-5, 1e-5, 1e-3),
            velocity_variances=variances(1e-5, 1e-5, 1e-3),
        )
        self._drive = make_drive()
        context.endpoints.append(self._drive.remove)
        self._commanded_at = 0.0  # s of simulated time
        self.subscribe(p.text("commandTopic", "cmd_vel"), "geometry_msgs/Twist", self._command)

    def _read_drive(self) -> Callable[[], Any]:
        """Read the parameters of the drive; return what makes it."""
        return lambda: PlanarDrive(self.world, self.context.model)

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


class ForceBasedMove(PlanarMove):
    """That of hector_gazebo_plugins: forces on <robotBaseFrame> that are proportional to the error of its velocity."""

    timeout = "cmdVelTimeOut"
    transform = "publishOdometryTf"

    def _read_drive(self) -> Callable[[], Any]:
        p = self.parameters
        gains = (
            p.number("x_velocity_p_gain", 10000.0, least=0.0),  # N s/m
            p.number("y_velocity_p_gain", 10000.0, least=0.0),
            p.number("yaw_velocity_p_gain", 100.0, least=0.0),  # N m s
        )
        link = self.link("robotBaseFrame", "base_footprint")
        return lambda: PlanarForceDrive(self.simulation, link, *gains)
