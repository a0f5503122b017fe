# SPDX-License-Identifier: BSD-3-Clause
"""gazebo_ros_tricycle_drive: a steered and driven front wheel, two rear wheels with encoders."""

from __future__ import annotations

import math

from bubblesim._core import MotorMode
from bubblesim.controllers.differential_drive import DifferentialDrive, WheelOdometry, Wheels
from bubblesim.controllers.speed_ramp import SpeedRamp, approached
from bubblesim.gazebo_plugins.drives.odometry import SOURCES, Odometry, covariance, motion_in_world, motion_on_plane
from bubblesim.gazebo_plugins.drives.wheels import WheelTopics, drive_by_velocity
from bubblesim.gazebo_plugins.plugin import Message, Plugin, PluginContext
from bubblesim.gazebo_plugins.rate import Rate

_RIGHT_ANGLE = math.pi / 2


class TricycleDrive(Plugin):
    """Parameters, topics and defaults are those of gazebo_ros_pkgs.

    As in Gazebo, a Twist's linear.x is the rim speed of the front wheel (m/s), its angular.z the steering angle (rad).
    """

    def __init__(self, context: PluginContext) -> None:
        """Read the parameters."""
        super().__init__(context)
        p = self.parameters
        self.enter_namespace(of_model=True)
        self._steering = self.joint("steeringJoint", "front_steering_joint")
        self._wheel = self.joint("actuatedWheelJoint", "front_wheel_joint")
        self._left = self.joint("encoderWheelLeftJoint", "left_wheel_joint")
        self._right = self.joint("encoderWheelRightJoint", "right_wheel_joint")
        self._radius = p.length("actuatedWheelDiameter", 0.15) / 2
        self._torque = p.number("wheelTorque", 5.0, least=0.0)
        self._acceleration = p.number("wheelAcceleration", 0.0, least=0.0)  # rad/s^2
        self._steering_speed = p.number("steeringSpeed", 0.0, least=0.0)
        p.ignore("wheelDeceleration", "wheelSpeedTolerance", "steeringAngleTolerance")
        diameter, separation = p.length("encoderWheelDiameter", 0.15), p.length("encoderWheelSeparation", 0.5)
        self._axle = DifferentialDrive(diameter / 2, separation)
        self._by_wheels = p.choice("odometrySource", "world", SOURCES) == "encoder"
        self._rate = Rate(p.number("updateRate", 100.0, least=0.0), self.simulation)
        p.check()
        self._odometry = Odometry(
            self,
            topic=p.text("odometryTopic", "odom"),
            frame=self.frame(p.text("odometryFrame", "odom")),
            base_frame=self.frame(p.text("robotBaseFrame", "base_link")),
            transform=True,
            pose_covariance=covariance(1e-5, 1e-5, 1e-3),
        )
        self._wheels = WheelTopics(self, (self._steering, self._wheel, self._left, self._right), efforts=True)
        self.subscribe(p.text("commandTopic", "cmd_vel"), "geometry_msgs/Twist", self._command)
        self._begin()

    def _begin(self) -> None:
        self._target_speed = self._target_angle = self._angle = 0.0
        self._ramp = SpeedRamp(self._acceleration, (0.0,))
        self._encoder = WheelOdometry(self._axle, self._angles())

    def _angles(self) -> Wheels:
        return Wheels(self.world.joint_position(self._left), self.world.joint_position(self._right))

    def _command(self, twist: Message) -> None:
        speed, angle = twist["linear"]["x"] / self._radius, twist["angular"]["z"]
        if self.usable("Twist", (speed, angle)):
            self._target_speed, self._target_angle = speed, max(-_RIGHT_ANGLE, min(angle, _RIGHT_ANGLE))

    def reset(self) -> None:
        """Stop and steer straight ahead."""
        self._begin()
        self._rate.reset()
        drive_by_velocity(self.world, [self._wheel], self._torque)
        self.world.set_motor_mode(self._steering, MotorMode.POSITION)
        self.world.set_max_force(self._steering, self._torque)

    def actuate(self) -> None:
        """Command the front wheel."""
        dt = self.simulation.time_step
        most = self._steering_speed * dt if self._steering_speed > 0 else math.inf
        self._angle = approached(self._angle, self._target_angle, most)
        self.world.set_target_position(self._steering, self._angle)
        (speed,) = self._ramp.update((self._target_speed,), dt)
        self.world.set_target_velocity(self._wheel, speed)

    def publish(self) -> None:
        """Publish the odometry and, if subscribed, the wheels' topics."""
        if self._by_wheels:
            self._encoder.update(self._angles(), self.simulation.time_step)
            motion = motion_on_plane(self._encoder.pose, self._encoder.velocity)
        else:
            motion = motion_in_world(self.world, self.context.model)
        if self._rate.due():
            self._odometry.publish(motion)
            self._wheels.publish()
