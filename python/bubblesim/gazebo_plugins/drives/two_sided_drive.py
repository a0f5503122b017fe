# SPDX-License-Identifier: BSD-3-Clause
"""Drive of robots with wheels on the left and on the right, commanded by a Twist."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from bubblesim.controllers.differential_drive import DifferentialDrive, WheelOdometry, Wheels, wheel_speeds
from bubblesim.controllers.planar_motion import Velocity
from bubblesim.controllers.speed_ramp import SpeedRamp
from bubblesim.gazebo_plugins.drives.odometry import Motion, motion_in_world, motion_on_plane
from bubblesim.gazebo_plugins.drives.wheels import drive_by_velocity
from bubblesim.gazebo_plugins.plugin import Message, Plugin


@dataclass(frozen=True)
class WheelGroup:
    """Joints of wheels with the same radius and track, on both sides."""

    geometry: DifferentialDrive
    left: Sequence[int]
    right: Sequence[int]


class TwoSidedDrive:
    """Used by a plugin, which calls it in each phase. Without commands the wheels stand still."""

    def __init__(
        self,
        plugin: Plugin,
        *groups: WheelGroup,
        torque: float | None = None,
        acceleration: float = 0.0,
    ) -> None:
        """Torque in N m, None for the joints' limits; acceleration of the rims in m/s^2, 0: no limit.

        The first wheels of the first group have the encoders.
        """
        self._plugin = plugin
        self._groups = groups
        self._torque = torque
        self._acceleration = acceleration
        self._stop()

    def _stop(self) -> None:
        self.target = Velocity(0.0, 0.0)
        self._ramps = [SpeedRamp(self._acceleration / g.geometry.wheel_radius, (0.0, 0.0)) for g in self._groups]
        self._encoder = WheelOdometry(self._groups[0].geometry, self._angles())

    def reset(self) -> None:
        """Stop and reset the odometry to the origin."""
        self._stop()
        for group in self._groups:
            drive_by_velocity(self._plugin.world, [*group.left, *group.right], self._torque)

    def subscribe(self, topic: str) -> None:
        """Subscribe to a command topic."""
        self._plugin.subscribe(topic, "geometry_msgs/Twist", self.set_command)

    def set_command(self, twist: Message) -> None:
        """Set the command from a geometry_msgs/Twist."""
        forward, turning = twist["linear"]["x"], twist["angular"]["z"]
        if self._plugin.usable("Twist", (forward, turning)):
            self.target = Velocity(forward, turning)

    def actuate(self) -> None:
        """Command the wheels from the last Twist."""
        self.command(self.target)

    def command(self, velocity: Velocity) -> None:
        """Command the wheels."""
        for group, ramp in zip(self._groups, self._ramps, strict=True):
            wanted = wheel_speeds(group.geometry, velocity)
            speeds = ramp.update((wanted.left, wanted.right), self._plugin.simulation.time_step)
            for joints, speed in zip((group.left, group.right), speeds, strict=True):
                for joint in joints:
                    self._plugin.world.set_target_velocity(joint, speed)

    def _angles(self) -> Wheels:
        """Return the angles of the first wheels on both sides."""
        position = self._plugin.world.joint_position
        return Wheels(position(self._groups[0].left[0]), position(self._groups[0].right[0]))

    def moved(self, *, by_wheels: bool) -> Motion:
        """Return the motion of the robot, from its encoders or exact; call it in each step."""
        if not by_wheels:
            return motion_in_world(self._plugin.world, self._plugin.context.model)
        velocity = self.encoder_velocity()
        return motion_on_plane(self._encoder.pose, velocity)

    def encoder_velocity(self) -> Velocity:
        """Return the velocity of the robot from its encoders; call it once in each step."""
        self._encoder.update(self._angles(), self._plugin.simulation.time_step)
        return self._encoder.velocity
