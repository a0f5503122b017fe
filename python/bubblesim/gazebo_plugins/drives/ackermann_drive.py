# SPDX-License-Identifier: BSD-3-Clause
"""gazebo_ros_ackermann_drive: a car with two steered front wheels and two driven rear ones."""

from __future__ import annotations

import math

from bubblesim.gazebo_plugins.drives.ackermann_plugin import AckermannPlugin
from bubblesim.gazebo_plugins.drives.ackermann_wheels import AckermannWheels
from bubblesim.gazebo_plugins.drives.odometry import Odometry, variances
from bubblesim.gazebo_plugins.drives.wheels import wheel_radius
from bubblesim.gazebo_plugins.plugin import Message, PluginContext
from bubblesim.gazebo_plugins.rate import Rate


class AckermannDrive(AckermannPlugin):
    """Parameters and defaults are those of gazebo_ros_pkgs in ROS 2; joint motors replace its PID controllers.

    As in Gazebo, a Twist's linear.x is the speed (m/s), its angular.z the steering angle (rad), to the left when
    driving forward.
    """

    def __init__(self, context: PluginContext) -> None:
        """Read the parameters."""
        super().__init__(context)
        p = self.parameters
        self.enter_namespace()
        fronts = [self.joint(name, name) for name in ("front_left_joint", "front_right_joint")]
        rears = [self.joint(name, name) for name in ("rear_left_joint", "rear_right_joint")]
        steering = [self.joint(name, name) for name in ("left_steering_joint", "right_steering_joint")]
        self._max_speed = p.number("max_speed", 20.0, least=0.0)
        self._max_steering = p.number("max_steer", 0.6, least=0.0)
        p.ignore("steering_wheel_joint", "max_steering_angle", "friction_model", "publish_distance", "publish_wheel_tf")
        for name in ("left_steering", "right_steering", "linear_velocity"):
            p.ignore(f"{name}_pid_gain", f"{name}_i_range")
        radius = wheel_radius(self, rears[0])
        if radius is None:
            raise p.fail("rear_left_joint", "names a joint whose wheel is neither a sphere nor a cylinder")
        left, right, rear_left, rear_right = (self.world.pose(joint)[:3] for joint in (*fronts, *rears))
        track = math.dist(left, right)
        middles = (
            [(a + b) / 2 for a, b in zip(*pair, strict=True)] for pair in ((left, right), (rear_left, rear_right))
        )
        self._wheels = AckermannWheels(
            self.world,
            steering,
            [[rear] for rear in rears],
            wheelbase=math.dist(*middles),
            track=track,
            steering_track=track,
            radius=radius,
        )
        self._rate = Rate(p.number("update_rate", 100.0, least=0.0), self.simulation)
        given = (p.number("covariance_x", 1e-5), p.number("covariance_y", 1e-5), p.number("covariance_yaw", 1e-3))
        publishes = p.flag("publish_odom", default=False)
        p.check()
        self._odometry = Odometry(
            self,
            topic="odom" if publishes else None,
            frame=p.text("odometry_frame", "odom"),
            base_frame=p.text("robot_base_frame", "base_footprint"),
            transform=p.flag("publish_odom_tf", default=False),
            pose_variances=variances(*given),
        )
        self.subscribe("cmd_vel", "geometry_msgs/Twist", self._command)

    def _command(self, twist: Message) -> None:
        speed, angle = twist["linear"]["x"], twist["angular"]["z"]
        if self.usable("Twist", (speed, angle)):
            self.steer(speed, math.copysign(1.0, speed) * angle)
