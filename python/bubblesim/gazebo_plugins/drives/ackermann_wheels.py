# SPDX-License-Identifier: BSD-3-Clause
"""The wheels of a car: two steered front wheels and driven rear wheels."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from bubblesim._core import MotorMode
from bubblesim.controllers.ackermann import front_wheel_angles, rear_wheel_speeds
from bubblesim.gazebo_plugins.drives.wheels import drive_by_velocity


class AckermannWheels:
    """The joints of the wheels, commanded by a speed and a steering angle at the middle of the car."""

    def __init__(
        self,
        world: Any,
        steering: Sequence[int],
        rears: Sequence[Sequence[int]],
        *,
        wheelbase: float,
        track: float,
        steering_track: float,
        radius: float,
    ) -> None:
        """Call `reset` before use. All lengths in metres.

        :param steering: the joints that turn the front wheels, the left one first.
        :param rears: the joints of the left and of the right rear wheels.
        :param track: between the rear wheels.
        :param steering_track: between the axes that the front wheels are steered about.
        :param radius: of the rear wheels.
        """
        self._world = world
        self._steering = steering
        self._rears = rears
        self._wheelbase = wheelbase
        self._track = track
        self._steering_track = steering_track
        self._radius = radius

    def reset(self) -> None:
        """Stop and steer straight ahead."""
        drive_by_velocity(self._world, [joint for side in self._rears for joint in side])
        for joint in self._steering:
            self._world.set_motor_mode(joint, MotorMode.POSITION)

    def command(self, speed_of_middle: float, angle: float) -> None:
        """Set the targets of the motors, from m/s and rad to the left."""
        speeds = rear_wheel_speeds(self._wheelbase, self._track, speed_of_middle, angle)
        for joints, speed in zip(self._rears, speeds, strict=True):
            for joint in joints:
                self._world.set_target_velocity(joint, speed / self._radius)
        angles = front_wheel_angles(self._wheelbase, self._steering_track, angle)
        for joint, position in zip(self._steering, angles, strict=True):
            self._world.set_target_position(joint, position)
