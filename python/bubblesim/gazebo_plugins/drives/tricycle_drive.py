# SPDX-License-Identifier: BSD-3-Clause
"""gazebo_ros_tricycle_drive: a steered and driven front wheel, two rear wheels with encoders."""

from __future__ import annotations

import math

from bubblesim._core import JointRamps, MotorMode
from bubblesim.controllers.differential_drive import DifferentialDrive, WheelOdometry, Wheels
from bubblesim.gazebo_plugins.drives.odometry import SOURCES, Odometry, motion_in_world, motion_on_plane, variances
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
        # rad/s^2 and rad/s; 0: no limit.
        rates = [p.number(name, 0.0, least=0.0) or math.inf for name in ("wheelAcceleration", "steeringSpeed")]
        p.ignore("wheelDeceleration", "wheelSpeedTolerance", "steeringAngleTolerance")
        diameter, separation = p.length("encoderWheelDiameter", 0.15), p.length("encoderWheelSeparation", 0.5)
        self._axle = DifferentialDrive(diameter / 2, separation)
        self._by_wheels = p.choice("odometrySource", "world", SOURCES) == "encoder"
        rate = p.number("updateRate", 100.0, least=0.0)
        self._rate = Rate(rate, self.simulation)
        p.check()
        outputs = [(self._wheel, MotorMode.VELOCITY, [1.0, 0.0]), (self._steering, MotorMode.POSITION, [0.0, 1.0])]
        self._ramps = JointRamps(self.world, context.model, rate, rates, outputs)
        context.endpoints.append(self._ramps.remove)
        self._odometry = Odometry(
            self,
            topic=p.text("odometryTopic", "odom"),
            frame=self.frame(p.text("odometryFrame", "odom")),
            base_frame=self.frame(p.text("robotBaseFrame", "base_link")),
            transform=True,
            pose_variances=variances(1e-5, 1e-5, 1e-3),
        )
        self._wheels = WheelTopics(self, (self._steering, self._wheel, self._left, self._right))
        self.subscribe(p.text("commandTopic", "cmd_vel"), "geometry_msgs/Twist", self._command)
        self._encoder = WheelOdometry(self._axle, self._angles())

    def _angles(self) -> Wheels:
        return Wheels(self.world.joint_position(self._left), self.world.joint_position(self._right))

    def _command(self, twist: Message) -> None:
        speed, angle = twist["linear"]["x"] / self._radius, twist["angular"]["z"]
        if self.usable("Twist", (speed, angle)):
            self._ramps.set_targets([speed, max(-_RIGHT_ANGLE, min(angle, _RIGHT_ANGLE))])

    def reset(self) -> None:
        """Stop and steer straight ahead."""
        self._encoder = WheelOdometry(self._axle, self._angles())
        self._ramps.stop()
        self._rate.reset()
        drive_by_velocity(self.world, [self._wheel], self._torque)
        self.world.set_motor_mode(self._steering, MotorMode.POSITION)
        self.world.set_max_force(self._steering, self._torque)

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
