# SPDX-License-Identifier: BSD-3-Clause
"""gazebo_ros_ackermann_drive: a car with two steered front wheels and two driven rear ones."""

from __future__ import annotations

import math

from bubblesim._core import MotorMode
from bubblesim.controllers.ackermann import front_wheel_angles, rear_wheel_speeds
from bubblesim.devices.device import Device, Message, Place
from bubblesim.devices.odometry import Odometry, covariance, motion_in_world
from bubblesim.devices.rate import Rate
from bubblesim.devices.wheels import drive_by_velocity, wheel_radius


class AckermannDrive(Device):
    """Parameters and defaults are those of gazebo_ros_pkgs in ROS 2; motors stand for its PID controllers.

    As there, a Twist's linear.x is the speed (m/s), its angular.z the steering angle (rad) to the left when driving
    forward.
    """

    def __init__(self, place: Place) -> None:
        """Read the parameters."""
        super().__init__(place)
        p = self.parameters
        self.enter_namespace()
        fronts = [self.joint(name, name) for name in ("front_left_joint", "front_right_joint")]
        self._rears = [self.joint(name, name) for name in ("rear_left_joint", "rear_right_joint")]
        self._steering = [self.joint(name, name) for name in ("left_steering_joint", "right_steering_joint")]
        self._max_speed = p.number("max_speed", 20.0, least=0.0)
        self._max_steering = p.number("max_steer", 0.6, least=0.0)
        p.ignore("steering_wheel_joint", "max_steering_angle", "friction_model", "publish_distance", "publish_wheel_tf")
        for name in ("left_steering", "right_steering", "linear_velocity"):
            p.ignore(f"{name}_pid_gain", f"{name}_i_range")
        radius = wheel_radius(self, self._rears[0])
        if radius is None:
            raise p.fail("rear_left_joint", "names a joint whose wheel is neither a sphere nor a cylinder")
        self._radius = radius
        left, right, rear_left, rear_right = (self.world.pose(joint)[:3] for joint in (*fronts, *self._rears))
        self._track = math.dist(left, right)
        middles = (
            [(a + b) / 2 for a, b in zip(*pair, strict=True)] for pair in ((left, right), (rear_left, rear_right))
        )
        self._wheelbase = math.dist(*middles)
        self._rate = Rate(p.number("update_rate", 100.0, least=0.0), self.simulation.time_step)
        variances = (p.number("covariance_x", 1e-5), p.number("covariance_y", 1e-5), p.number("covariance_yaw", 1e-3))
        tells = p.flag("publish_odom", default=False)
        p.check()
        self._odometry = Odometry(
            self,
            topic="odom" if tells else None,
            frame=p.text("odometry_frame", "odom"),
            base_frame=p.text("robot_base_frame", "base_footprint"),
            transform=p.flag("publish_odom_tf", default=False),
            pose_covariance=covariance(*variances),
        )
        self._speed = self._angle = 0.0
        self.subscribe("cmd_vel", "geometry_msgs/Twist", self._command)

    def _command(self, twist: Message) -> None:
        speed, angle = twist["linear"]["x"], twist["angular"]["z"]
        if self.usable("Twist", (speed, angle)):
            self._speed = max(-self._max_speed, min(speed, self._max_speed))
            angle = math.copysign(1.0, speed) * angle
            self._angle = max(-self._max_steering, min(angle, self._max_steering))

    def reset(self) -> None:
        """Stand still, steer ahead."""
        self._speed = self._angle = 0.0
        self._rate.reset()
        drive_by_velocity(self.world, self._rears)
        for joint in self._steering:
            self.world.set_motor_mode(joint, MotorMode.POSITION)

    def actuate(self) -> None:
        """Command the wheels."""
        speeds = rear_wheel_speeds(self._wheelbase, self._track, self._speed, self._angle)
        for joint, speed in zip(self._rears, speeds, strict=True):
            self.world.set_target_velocity(joint, speed / self._radius)
        angles = front_wheel_angles(self._wheelbase, self._track, self._angle)
        for joint, angle in zip(self._steering, angles, strict=True):
            self.world.set_target_position(joint, angle)

    def publish(self) -> None:
        """Tell the odometry."""
        if self._rate.due(self.simulation.time):
            self._odometry.publish(motion_in_world(self.world, self.place.model))
