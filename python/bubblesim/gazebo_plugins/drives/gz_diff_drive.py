# SPDX-License-Identifier: BSD-3-Clause
"""gz-sim's DiffDrive: topics have its names and defaults, with ROS types."""

from __future__ import annotations

import math

from bubblesim.controllers.differential_drive import DifferentialDrive
from bubblesim.controllers.planar_motion import Velocity
from bubblesim.gazebo_plugins.drives.gz_odometry import drive_odometry
from bubblesim.gazebo_plugins.drives.two_sided_drive import TwoSidedDrive, WheelGroup
from bubblesim.gazebo_plugins.plugin import FASTEST, Message, Plugin, PluginContext
from bubblesim.gazebo_plugins.rate import Rate


class GzDiffDrive(Plugin):
    """Any number of wheels on both sides. The transform is published on /tf; <tf_topic> is ignored."""

    def __init__(self, context: PluginContext) -> None:
        """Read the parameters."""
        super().__init__(context)
        p = self.parameters
        model = self.world.name(context.model)
        self._left, self._right = (self._wheels(f"{side}_joint") for side in ("left", "right"))
        geometry = DifferentialDrive(p.length("wheel_radius", 0.2), p.length("wheel_separation", 1.0), FASTEST)
        self._max_velocities = [self._limit(kind, "velocity") for kind in ("linear", "angular")]
        accelerations = self._limit("linear", "acceleration"), self._limit("angular", "acceleration")
        self._rate = Rate(p.number("odom_publish_frequency", 50.0, least=0.0), self.simulation)
        p.ignore("tf_topic", "min_jerk", "max_jerk", "min_linear_jerk", "max_linear_jerk")
        p.check()
        self._drive = TwoSidedDrive(self, WheelGroup(geometry, self._left, self._right), velocity_rates=accelerations)
        self._odometry = drive_odometry(self)
        self.subscribe(p.text("topic", f"/model/{model}/cmd_vel"), "geometry_msgs/Twist", self._command)

    def _wheels(self, parameter: str) -> list[int]:
        names = self.parameters.names(parameter)
        if not names:
            raise self.parameters.fail(parameter, "is missing: it names the joint of a wheel")
        return [self.joint_named(name, parameter) for name in names]

    def _limit(self, kind: str, what: str) -> float:
        """Return the maximum velocity or acceleration of one kind, or of both; the minimum is its negative."""
        p = self.parameters
        p.ignore(f"min_{kind}_{what}", f"min_{what}")
        return p.number(f"max_{kind}_{what}", p.number(f"max_{what}", math.inf, least=0.0), least=0.0)

    def _command(self, twist: Message) -> None:
        wanted = twist["linear"]["x"], twist["angular"]["z"]
        if self.usable("Twist", wanted):
            limited = (max(-most, min(to, most)) for to, most in zip(wanted, self._max_velocities, strict=True))
            self._drive.command(Velocity(*limited))

    def reset(self) -> None:
        """Stop."""
        self._drive.reset()
        self._rate.reset()

    def publish(self) -> None:
        """Publish the odometry of the wheels."""
        motion = self._drive.moved(by_wheels=True)
        if self._rate.due():
            self._odometry.publish(motion)
