# SPDX-License-Identifier: BSD-3-Clause
"""The drive of robots with wheels on the left and on the right, commanded by a Twist."""

from __future__ import annotations

from collections.abc import Sequence

from bubblesim.controllers.differential_drive import DifferentialDrive, WheelOdometry, Wheels, wheel_speeds
from bubblesim.controllers.planar_motion import Velocity
from bubblesim.controllers.speed_ramp import SpeedRamp
from bubblesim.devices.device import Device, Message
from bubblesim.devices.odometry import Motion, motion_in_world, motion_on_plane
from bubblesim.devices.wheels import drive_by_velocity


class TwoSidedDrive:
    """A part of a device, which calls it in each phase. Without commands the wheels stand still."""

    def __init__(
        self,
        device: Device,
        drive: DifferentialDrive,
        left: Sequence[int],
        right: Sequence[int],
        *,
        torque: float | None = None,
        acceleration: float = 0.0,
    ) -> None:
        """Joints on both sides; torque in N m, None for the joints' own; acceleration of the rims in m/s^2, 0: any."""
        self._device = device
        self._drive = drive
        self._left = left
        self._right = right
        self._torque = torque
        self._acceleration = acceleration / drive.wheel_radius
        self.wanted = Velocity(0.0, 0.0)
        self._ramp = SpeedRamp(self._acceleration, (0.0, 0.0))
        self._encoder = WheelOdometry(drive, self._angles())

    def reset(self) -> None:
        """Stand still, at the origin of the odometry."""
        self.wanted = Velocity(0.0, 0.0)
        self._ramp = SpeedRamp(self._acceleration, (0.0, 0.0))
        self._encoder = WheelOdometry(self._drive, self._angles())
        drive_by_velocity(self._device.world, [*self._left, *self._right], self._torque)

    def hear(self, topic: str) -> None:
        """Take commands from a topic."""
        self._device.subscribe(topic, "geometry_msgs/Twist", self._command)

    def _command(self, twist: Message) -> None:
        forward, turning = twist["linear"]["x"], twist["angular"]["z"]
        if self._device.usable("Twist", (forward, turning)):
            self.wanted = Velocity(forward, turning)

    def actuate(self) -> None:
        """Command the wheels as the Twist wants it."""
        self.command(self.wanted)

    def command(self, velocity: Velocity) -> None:
        """Command the wheels."""
        wanted = wheel_speeds(self._drive, velocity)
        speeds = self._ramp.update((wanted.left, wanted.right), self._device.simulation.time_step)
        for joints, speed in zip((self._left, self._right), speeds, strict=True):
            for joint in joints:
                self._device.world.set_target_velocity(joint, speed)

    def _angles(self) -> Wheels:
        """Of the first wheels on both sides."""
        position = self._device.world.joint_position
        return Wheels(position(self._left[0]), position(self._right[0]))

    def moved(self, *, by_wheels: bool) -> Motion:
        """How the robot moves, as its wheels say or exactly; to be asked in each pass."""
        if not by_wheels:
            return motion_in_world(self._device.world, self._device.place.model)
        self._encoder.update(self._angles(), self._device.simulation.time_step)
        return motion_on_plane(self._encoder.pose, self._encoder.velocity)
