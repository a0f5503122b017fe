# SPDX-License-Identifier: BSD-3-Clause
"""gz-sim's AckermannSteering: names and defaults are those of its topics, the types are ROS's."""

from __future__ import annotations

import math

from bubblesim._core import MotorMode
from bubblesim.controllers.ackermann import front_wheel_angles, rear_wheel_speeds
from bubblesim.devices.device import Device, Message, Place
from bubblesim.devices.odometry import Odometry, covariance, motion_in_world
from bubblesim.devices.rate import Rate
from bubblesim.devices.wheels import drive_by_velocity

SIDES = ("left", "right")


class GzAckermannSteering(Device):
    """A Twist's angular.z is the rate of turn (rad/s). The odometry is exact; its transform goes to /tf."""

    def __init__(self, place: Place) -> None:
        """Read the parameters."""
        super().__init__(place)
        p = self.parameters
        model = self.world.name(place.model)
        self._left, self._right = ([self.joint_named(n, f"{s}_joint") for n in p.names(f"{s}_joint")] for s in SIDES)
        self._steering = [self.joint(f"{side}_steering_joint", "") for side in SIDES]
        self._track = p.length("wheel_separation", 1.0)
        self._kingpins = p.length("kingpin_width", 0.8)
        self._wheelbase = p.length("wheel_base", 1.0)
        self._radius = p.length("wheel_radius", 0.2)
        self._most_steering = p.length("steering_limit", 0.5)
        self._fastest = p.number("max_velocity", math.inf, least=0.0)
        p.ignore("tf_topic", "min_velocity", "min_acceleration", "max_acceleration", "min_jerk", "max_jerk")
        self._rate = Rate(p.number("odom_publish_frequency", 50.0, least=0.0), self.simulation.time_step)
        p.check()
        self._odometry = Odometry(
            self,
            topic=p.text("odom_topic", f"/model/{model}/odometry"),
            frame=p.text("frame_id", f"{model}/odom"),
            base_frame=p.text("child_frame_id", f"{model}/base_link"),
            transform=True,
            pose_covariance=covariance(1e-5, 1e-5, 1e-3),
        )
        self._speed = self._angle = 0.0
        self.subscribe(p.text("topic", f"/model/{model}/cmd_vel"), "geometry_msgs/Twist", self._command)

    def _command(self, twist: Message) -> None:
        speed, turning = twist["linear"]["x"], twist["angular"]["z"]
        if not self.usable("Twist", (speed, turning)):
            return
        self._speed = max(-self._fastest, min(speed, self._fastest))
        angle = math.atan2(self._wheelbase * turning * math.copysign(1.0, speed), abs(speed)) if turning else 0.0
        self._angle = max(-self._most_steering, min(angle, self._most_steering))

    def reset(self) -> None:
        """Stand still, steer ahead."""
        self._speed = self._angle = 0.0
        self._rate.reset()
        drive_by_velocity(self.world, [*self._left, *self._right])
        for joint in self._steering:
            self.world.set_motor_mode(joint, MotorMode.POSITION)

    def actuate(self) -> None:
        """Command the wheels."""
        speeds = rear_wheel_speeds(self._wheelbase, self._track, self._speed, self._angle)
        for joints, speed in zip((self._left, self._right), speeds, strict=True):
            for joint in joints:
                self.world.set_target_velocity(joint, speed / self._radius)
        angles = front_wheel_angles(self._wheelbase, self._kingpins, self._angle)
        for joint, angle in zip(self._steering, angles, strict=True):
            self.world.set_target_position(joint, angle)

    def publish(self) -> None:
        """Tell the odometry."""
        if self._rate.due(self.simulation.time):
            self._odometry.publish(motion_in_world(self.world, self.place.model))
