# SPDX-License-Identifier: BSD-3-Clause
"""Drive of robots with wheels on the left and on the right, commanded by a Twist."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

from bubblesim._core import JointRamps, MotorMode
from bubblesim.controllers.differential_drive import DifferentialDrive, WheelOdometry, Wheels, wheel_speeds
from bubblesim.controllers.planar_motion import Velocity
from bubblesim.gazebo_plugins.drives.odometry import Motion, motion_in_world, motion_on_plane
from bubblesim.gazebo_plugins.drives.wheels import drive_by_velocity
from bubblesim.gazebo_plugins.plugin import FASTEST, Message, Plugin

STILL = Velocity(0.0, 0.0)


@dataclass(frozen=True)
class WheelGroup:
    """Joints of wheels with the same radius and track, on both sides."""

    geometry: DifferentialDrive
    left: Sequence[int]
    right: Sequence[int]


class TwoSidedDrive:
    """Used by a plugin. Without commands the wheels stand still; a device of the world accelerates them."""

    def __init__(
        self,
        plugin: Plugin,
        *groups: WheelGroup,
        torque: float | None = None,
        acceleration: float = 0.0,
        velocity_rates: tuple[float, float] | None = None,
        rate: float = 0.0,
    ) -> None:
        """Torque in N m, None for the joints' limits; acceleration of the rims in m/s^2, 0: no limit.

        The first wheels of the first group have the encoders.

        :param velocity_rates: m/s^2 and rad/s^2 of the robot, instead of the acceleration of each rim.
        :param rate: of the commands to the wheels, Hz; 0: in each physics substep.
        """
        self._plugin = plugin
        self._groups = groups
        self._torque = torque
        self._whole = velocity_rates is not None
        if velocity_rates is not None:
            rates = list(velocity_rates)
            outputs = [output for group in groups for output in _of_robot(group)]
        else:
            rates = [acceleration / g.geometry.wheel_radius or math.inf for g in groups for _ in range(2)]
            outputs = [output for index, group in enumerate(groups) for output in _of_rims(group, index, len(groups))]
        self._ramps = JointRamps(plugin.world, plugin.context.model, rate, rates, outputs)
        plugin.context.endpoints.append(self._ramps.remove)
        self._begin()

    def _begin(self) -> None:
        self.target = self._commanded = STILL
        self._encoder = WheelOdometry(self._groups[0].geometry, self._angles())

    def reset(self) -> None:
        """Stop and reset the odometry to the origin."""
        self._begin()
        self._ramps.stop()
        for group in self._groups:
            drive_by_velocity(self._plugin.world, [*group.left, *group.right], self._torque)

    def subscribe(self, topic: str) -> None:
        """Subscribe to a command topic. The commands reach the wheels without Python."""
        target = self._ramps.commands(self._rows(), FASTEST)
        self._plugin.subscribe_numbers(topic, "geometry_msgs/Twist", ("linear.x", "angular.z"), target)

    def _rows(self) -> list[tuple[list[float], float]]:
        """Return how the inputs of the ramps depend on the robot's velocities; see ``command``."""
        if self._whole:
            return [([1.0, 0.0], 1.0), ([0.0, 1.0], 1.0)]
        shapes = [group.geometry for group in self._groups]
        return [([1.0, side * shape.track / 2], shape.wheel_radius) for shape in shapes for side in (-1.0, 1.0)]

    def set_command(self, twist: Message) -> None:
        """Command the wheels by a geometry_msgs/Twist."""
        forward, turning = twist["linear"]["x"], twist["angular"]["z"]
        if self._plugin.usable("Twist", (forward, turning)):
            self.target = Velocity(forward, turning)
            self.command(self.target)

    def command(self, velocity: Velocity) -> None:
        """Command the wheels."""
        self._commanded = velocity
        if self._whole:
            self._ramps.set_targets([velocity.linear, velocity.angular])
        else:
            speeds = [wheel_speeds(group.geometry, velocity) for group in self._groups]
            self._ramps.set_targets([speed for pair in speeds for speed in (pair.left, pair.right)])

    def keep(self, velocity: Velocity) -> None:
        """Command the wheels unless this was the last command."""
        if velocity != self._commanded:
            self.command(velocity)

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


_Output = tuple[int, MotorMode, list[float]]


def _of_rims(group: WheelGroup, index: int, groups: int) -> list[_Output]:
    """Return the outputs of a group whose inputs are the speeds of the wheels of all groups, left and right."""
    outputs: list[_Output] = []
    for side, joints in enumerate((group.left, group.right)):
        factors = [float(column == 2 * index + side) for column in range(2 * groups)]
        outputs += [(joint, MotorMode.VELOCITY, factors) for joint in joints]
    return outputs


def _of_robot(group: WheelGroup) -> list[_Output]:
    """Return the outputs of a group whose inputs are the robot's velocities."""
    radius, half = group.geometry.wheel_radius, group.geometry.track / 2
    outputs: list[_Output] = []
    for sign, joints in ((-1.0, group.left), (1.0, group.right)):
        outputs += [(joint, MotorMode.VELOCITY, [1.0 / radius, sign * half / radius]) for joint in joints]
    return outputs
