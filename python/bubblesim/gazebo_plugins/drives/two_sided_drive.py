# SPDX-License-Identifier: BSD-3-Clause
"""The drive of robots with wheels on the left and on the right, commanded by a Twist."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from bubblesim.controllers.differential_drive import DifferentialDrive, WheelOdometry, Wheels, wheel_speeds
from bubblesim.controllers.planar_motion import Velocity
from bubblesim.controllers.speed_ramp import SpeedRamp
from bubblesim.gazebo_plugins.device import Device, Message
from bubblesim.gazebo_plugins.drives.odometry import Motion, motion_in_world, motion_on_plane
from bubblesim.gazebo_plugins.drives.wheels import drive_by_velocity


@dataclass(frozen=True)
class WheelGroup:
    """Wheels of one radius and one distance between the sides; their joints on both sides."""

    geometry: DifferentialDrive
    left: Sequence[int]
    right: Sequence[int]


class TwoSidedDrive:
    """A part of a device, which calls it in each phase. Without commands the wheels stand still."""

    def __init__(
        self,
        device: Device,
        *groups: WheelGroup,
        torque: float | None = None,
        acceleration: float = 0.0,
    ) -> None:
        """Torque in N m, None for the joints' own; acceleration of the rims in m/s^2, 0: any.

        The first wheels of the first group have the encoders.
        """
        self._device = device
        self._groups = groups
        self._torque = torque
        self._acceleration = acceleration
        self._stand_still()

    def _stand_still(self) -> None:
        self.wanted = Velocity(0.0, 0.0)
        self._ramps = [SpeedRamp(self._acceleration / g.geometry.wheel_radius, (0.0, 0.0)) for g in self._groups]
        self._encoder = WheelOdometry(self._groups[0].geometry, self._angles())

    def reset(self) -> None:
        """Stand still, at the origin of the odometry."""
        self._stand_still()
        for group in self._groups:
            drive_by_velocity(self._device.world, [*group.left, *group.right], self._torque)

    def hear(self, topic: str) -> None:
        """Take commands from a topic."""
        self._device.subscribe(topic, "geometry_msgs/Twist", self.take)

    def take(self, twist: Message) -> None:
        """Take a geometry_msgs/Twist for the command."""
        forward, turning = twist["linear"]["x"], twist["angular"]["z"]
        if self._device.usable("Twist", (forward, turning)):
            self.wanted = Velocity(forward, turning)

    def actuate(self) -> None:
        """Command the wheels as the Twist wants it."""
        self.command(self.wanted)

    def command(self, velocity: Velocity) -> None:
        """Command the wheels."""
        for group, ramp in zip(self._groups, self._ramps, strict=True):
            wanted = wheel_speeds(group.geometry, velocity)
            speeds = ramp.update((wanted.left, wanted.right), self._device.simulation.time_step)
            for joints, speed in zip((group.left, group.right), speeds, strict=True):
                for joint in joints:
                    self._device.world.set_target_velocity(joint, speed)

    def _angles(self) -> Wheels:
        """Of the first wheels on both sides."""
        position = self._device.world.joint_position
        return Wheels(position(self._groups[0].left[0]), position(self._groups[0].right[0]))

    def moved(self, *, by_wheels: bool) -> Motion:
        """How the robot moves, as its wheels say or exactly; to be asked in each step."""
        if not by_wheels:
            return motion_in_world(self._device.world, self._device.context.model)
        velocity = self.encoder_velocity()
        return motion_on_plane(self._encoder.pose, velocity)

    def encoder_velocity(self) -> Velocity:
        """How fast the robot moves, as its wheels say; to be asked once in each step."""
        self._encoder.update(self._angles(), self._device.simulation.time_step)
        return self._encoder.velocity
