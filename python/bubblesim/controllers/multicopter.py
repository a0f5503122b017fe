# SPDX-License-Identifier: BSD-3-Clause
"""Flies a multicopter to a place: PID control of the position, PD control of the attitude, mixing to rotor speeds."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace

from bubblesim.geometry.frames import into
from bubblesim.geometry.rotations import matrix

GRAVITY = 9.81  # m/s^2
_FASTEST = 5.0  # m/s^2, acceleration along the horizontal and the vertical
_FARTHEST = 1.0  # m, of the error of the position that is controlled


@dataclass(frozen=True)
class RotorPlace:
    """Where a rotor is, from the centre of mass, and which way it turns."""

    x: float  # m, forward
    y: float  # m, leftward
    turning: int  # 1 counter-clockwise seen from above, -1 clockwise


@dataclass(frozen=True)
class Airframe:
    """Masses and rotors; by default those of the model quadcopter. The rotors are at the corners of a square."""

    mass: float = 1.5  # kg
    inertia: tuple[float, float, float] = (0.0172, 0.0172, 0.0323)  # kg m^2, about x, y, z
    thrust_coefficient: float = 8.54858e-6  # N s^2: thrust = coefficient * speed^2
    torque_length: float = 0.016  # m: reaction torque = length * thrust
    max_speed: float = 838.0  # rad/s
    rotors: tuple[RotorPlace, ...] = (
        RotorPlace(0.17, -0.17, 1),
        RotorPlace(-0.17, 0.17, 1),
        RotorPlace(0.17, 0.17, -1),
        RotorPlace(-0.17, -0.17, -1),
    )


@dataclass(frozen=True)
class State:
    """Position in m, orientation as x, y, z, w, and velocities in m/s and rad/s, in world axes."""

    position: Sequence[float]
    orientation: Sequence[float]
    linear: Sequence[float]
    angular: Sequence[float]


@dataclass(frozen=True)
class Goal:
    """A place to hover at, in m, and a heading in rad; they move with a velocity in the frame of the heading."""

    position: Sequence[float]
    heading: float = 0.0
    velocity: Sequence[float] = (0.0, 0.0, 0.0)  # m/s
    yaw_rate: float = 0.0  # rad/s

    def moving(self, velocity: Sequence[float], yaw_rate: float) -> Goal:
        """Return this goal with other velocities."""
        return replace(self, velocity=velocity, yaw_rate=yaw_rate)

    def at_rest(self) -> Goal:
        """Return this goal without velocities."""
        return self.moving((0.0, 0.0, 0.0), 0.0)

    def world_velocity(self) -> tuple[float, float, float]:
        """Return the velocity in world axes."""
        x, y, z = self.velocity
        along, across = math.cos(self.heading), math.sin(self.heading)
        return along * x - across * y, across * x + along * y, z

    def after(self, seconds: float, lowest: float) -> Goal:
        """Return the goal after a time; it stays above a height."""
        moved = [p + v * seconds for p, v in zip(self.position, self.world_velocity(), strict=True)]
        moved[2] = max(moved[2], lowest)
        return replace(self, position=moved, heading=self.heading + self.yaw_rate * seconds)


class MulticopterControl:
    """Position to acceleration to attitude to torques to rotor speeds. The integral part balances the wind."""

    stiffness, damping, integral = 4.0, 3.6, 1.5  # 1/s^2, 1/s, 1/s^3: position
    attitude_gains = ((100.0, 18.0), (100.0, 18.0), (6.0, 4.5))  # 1/s^2, 1/s: roll, pitch and yaw

    def __init__(self, airframe: Airframe) -> None:
        """Start on the ground."""
        self._airframe = airframe
        self._offset = [0.0, 0.0, 0.0]  # m/s^2, the integral part

    def update(self, state: State, goal: Goal, dt: float) -> list[float]:
        """Return the speeds of the rotors, rad/s; positive counter-clockwise."""
        force = self._acceleration(state, goal, dt)
        force[2] += GRAVITY  # per mass
        upward = [row[2] for row in matrix(state.orientation)]
        thrust = self._airframe.mass * max(sum(a * b for a, b in zip(force, upward, strict=True)), 0.1 * GRAVITY)
        return self._speeds(thrust, self._torques(state, goal.heading, force))

    def _acceleration(self, state: State, goal: Goal, dt: float) -> list[float]:
        wanted = []
        for axis, velocity in enumerate(goal.world_velocity()):
            error = min(max(goal.position[axis] - state.position[axis], -_FARTHEST), _FARTHEST)
            if abs(error) < 0.5 * _FARTHEST:  # not while it flies to a distant goal
                offset = self._offset[axis] + self.integral * error * dt
                self._offset[axis] = min(max(offset, -_FASTEST), _FASTEST)
            slowing = self.damping * (velocity - state.linear[axis])
            wanted.append(self.stiffness * error + slowing + self._offset[axis])
        sideways = min(1.0, _FASTEST / max(math.hypot(*wanted[:2]), 1e-9))
        return [wanted[0] * sideways, wanted[1] * sideways, min(max(wanted[2], -_FASTEST), _FASTEST)]

    def _torques(self, state: State, heading: float, force: Sequence[float]) -> list[float]:
        roll, pitch, yaw = _roll_pitch_yaw(state.orientation)
        ahead = math.cos(yaw) * force[0] + math.sin(yaw) * force[1]
        leftward = math.cos(yaw) * force[1] - math.sin(yaw) * force[0]
        errors = (
            math.atan2(-leftward, math.hypot(ahead, force[2])) - roll,
            math.atan2(ahead, force[2]) - pitch,
            math.remainder(heading - yaw, 2.0 * math.pi),
        )
        rates = into((0.0, 0.0, 0.0, *state.orientation), state.angular)
        return [
            inertia * (stiffness * error - damping * rate)
            for inertia, (stiffness, damping), error, rate in zip(
                self._airframe.inertia, self.attitude_gains, errors, rates, strict=True
            )
        ]

    def _speeds(self, thrust: float, torques: Sequence[float]) -> list[float]:
        frame = self._airframe
        count = len(frame.rotors)
        speeds = []
        for rotor in frame.rotors:
            share = (
                thrust / count
                + torques[0] / (count * rotor.y)
                - torques[1] / (count * rotor.x)
                - rotor.turning * torques[2] / (count * frame.torque_length)
            )
            speed = min(math.sqrt(max(share, 0.0) / frame.thrust_coefficient), frame.max_speed)
            speeds.append(rotor.turning * speed)
        return speeds


def _roll_pitch_yaw(quaternion: Sequence[float]) -> tuple[float, float, float]:
    rotation = matrix(quaternion)
    return (
        math.atan2(rotation[2][1], rotation[2][2]),
        math.asin(min(max(-rotation[2][0], -1.0), 1.0)),
        math.atan2(rotation[1][0], rotation[0][0]),
    )
