# SPDX-License-Identifier: BSD-3-Clause
"""gazebo_ros_skid_steer_drive: four driven wheels, commanded by a Twist."""

from __future__ import annotations

from bubblesim.controllers.differential_drive import DifferentialDrive
from bubblesim.gazebo_plugins.drives.odometry import Odometry, variances
from bubblesim.gazebo_plugins.drives.two_sided_drive import TwoSidedDrive, WheelGroup
from bubblesim.gazebo_plugins.plugin import FASTEST, Plugin, PluginContext
from bubblesim.gazebo_plugins.rate import Rate


class SkidSteerDrive(Plugin):
    """Parameters, topics and defaults are those of gazebo_ros_pkgs; the odometry is exact."""

    def __init__(self, context: PluginContext) -> None:
        """Read the parameters."""
        super().__init__(context)
        p = self.parameters
        self.enter_namespace()
        left = [self.joint(f"left{row}Joint", f"left_{row.lower()}_joint") for row in ("Front", "Rear")]
        right = [self.joint(f"right{row}Joint", f"right_{row.lower()}_joint") for row in ("Front", "Rear")]
        geometry = DifferentialDrive(p.length("wheelDiameter", 0.15) / 2, p.length("wheelSeparation", 0.4), FASTEST)
        torque = p.number("torque", 5.0, least=0.0)
        rate = p.number("updateRate", 100.0, least=0.0)
        self._rate = Rate(rate, self.simulation)
        given = (p.number("covariance_x", 1e-4), p.number("covariance_y", 1e-4), p.number("covariance_yaw", 1e-2))
        p.check()
        self._drive = TwoSidedDrive(self, WheelGroup(geometry, left, right), torque=torque, rate=rate)
        self._odometry = Odometry(
            self,
            topic=p.text("odometryTopic", "odom"),
            frame=p.text("odometryFrame", "odom"),
            base_frame=p.text("robotBaseFrame", "base_footprint"),
            transform=p.flag("broadcastTF", default=False),
            pose_variances=variances(*given),
            velocity_variances=variances(*given),
        )
        self._drive.subscribe(p.text("commandTopic", "cmd_vel"))

    def reset(self) -> None:
        """Stop."""
        self._drive.reset()
        self._rate.reset()

    def publish(self) -> None:
        """Publish the odometry."""
        if self._rate.due():
            self._odometry.publish(self._drive.moved(by_wheels=False))
