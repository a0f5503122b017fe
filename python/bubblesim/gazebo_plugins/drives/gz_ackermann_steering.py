# SPDX-License-Identifier: BSD-3-Clause
"""gz-sim's AckermannSteering: topics have its names and defaults, with ROS types."""

from __future__ import annotations

import math

from bubblesim.gazebo_plugins.drives.ackermann_plugin import AckermannPlugin
from bubblesim.gazebo_plugins.drives.ackermann_wheels import AckermannWheels
from bubblesim.gazebo_plugins.drives.gz_odometry import drive_odometry
from bubblesim.gazebo_plugins.plugin import Message, PluginContext
from bubblesim.gazebo_plugins.rate import Rate

SIDES = ("left", "right")


class GzAckermannSteering(AckermannPlugin):
    """A Twist's angular.z is the rate of turn (rad/s). The odometry is exact; its transform goes to /tf."""

    def __init__(self, context: PluginContext) -> None:
        """Read the parameters."""
        super().__init__(context)
        p = self.parameters
        model = self.world.name(context.model)
        rears = [[self.joint_named(n, f"{side}_joint") for n in p.names(f"{side}_joint")] for side in SIDES]
        steering = [self.joint(f"{side}_steering_joint", "") for side in SIDES]
        self._wheelbase = p.length("wheel_base", 1.0)
        self._wheels = AckermannWheels(
            self.world,
            steering,
            rears,
            wheelbase=self._wheelbase,
            track=p.length("wheel_separation", 1.0),
            steering_track=p.length("kingpin_width", 0.8),
            radius=p.length("wheel_radius", 0.2),
        )
        self._max_steering = p.length("steering_limit", 0.5)
        self._max_speed = p.number("max_velocity", math.inf, least=0.0)
        p.ignore("tf_topic", "min_velocity", "min_acceleration", "max_acceleration", "min_jerk", "max_jerk")
        self._rate = Rate(p.number("odom_publish_frequency", 50.0, least=0.0), self.simulation)
        p.check()
        self._odometry = drive_odometry(self)
        self.subscribe(p.text("topic", f"/model/{model}/cmd_vel"), "geometry_msgs/Twist", self._command)

    def _command(self, twist: Message) -> None:
        speed, turning = twist["linear"]["x"], twist["angular"]["z"]
        if not self.usable("Twist", (speed, turning)):
            return
        angle = math.atan2(self._wheelbase * turning * math.copysign(1.0, speed), abs(speed)) if turning else 0.0
        self.steer(speed, angle)
