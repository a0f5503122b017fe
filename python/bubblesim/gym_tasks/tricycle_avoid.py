# SPDX-License-Identifier: BSD-3-Clause
"""TricycleAvoid: drive through a room with obstacles by a single sonar."""

from __future__ import annotations

from typing import ClassVar

import numpy as np
from gymnasium import spaces

import bubblesim
from bubblesim.gym_tasks.task import Array, Task, headings, upright

STEERING, SPEED = 1.2, 3.0  # rad, rad/s of the front wheel of radius 0.3 m: actions 1
NO_ECHO = 2.5  # m, range of the sonar
STARTS = [(-2.5, -1.2), (-2.5, 2.5), (0.0, 0.0), (0.0, 1.5)]  # m, where it has room to turn
STUCK = 40  # steps


class TricycleAvoid(Task):
    """Actions: steering angle (from -1.2 to 1.2 rad) and speed (from 0 to 0.9 m/s), as -1 to 1, for 0.05 s.

    Observation: distance measured by the sonar as a fraction of 2.5 m, steering angle (rad), forward velocity (m/s).
    Reward: metres driven forward. The episode ends when the robot has not moved for 2 s: it stands at an obstacle.
    """

    scene: ClassVar[str] = "tricycle"
    camera: ClassVar[str] = "/Camera"
    actions: ClassVar = ["/Steering.target_position", "/FrontMotor.target_velocity"]
    observations: ClassVar = [
        "/FrontSonar.detected",
        "/FrontSonar.distance",
        "/Steering.joint_position",
        "/Tricycle.pose",
        "/Tricycle.velocity",
    ]
    action_space = spaces.Box(-1.0, 1.0, (2,), np.float32)
    observation_space = spaces.Box(np.array([0, -1.6, -2], np.float32), np.array([1, 1.6, 2], np.float32))

    def __init__(self, worlds: int) -> None:
        """Make the rules."""
        super().__init__(worlds)
        self._standing: Array = np.zeros(worlds, dtype=int)  # steps

    def place(self, world: int, simulation: bubblesim.Simulation, random: np.random.Generator) -> None:
        """Draw one of some starts, and the heading."""
        robot = simulation.object("/Tricycle")
        robot.position = [*STARTS[random.integers(len(STARTS))], 0.0]
        robot.orientation = upright(random.uniform(-np.pi, np.pi))
        self._standing[world] = 0

    def commands(self, actions: Array) -> Array:
        """Return the steering angle and the speed of the front wheel."""
        wanted = np.clip(actions, -1.0, 1.0).astype(np.float64)
        return np.column_stack([STEERING * wanted[:, 0], SPEED * (wanted[:, 1] + 1) / 2])

    def observe(self, rows: Array) -> Array:
        """Return distance, steering angle and velocity."""
        distances = np.where(rows[:, 0] > 0, rows[:, 1], NO_ECHO) / NO_ECHO
        return np.column_stack([distances, rows[:, 2], self._forward(rows)])

    def judge(self, rows: Array) -> tuple[Array, Array, dict[str, Array]]:
        """Return the distance of the step."""
        forward = self._forward(rows)
        self._standing = np.where(np.abs(forward) < 0.02, self._standing + 1, 0)
        return 0.05 * forward, self._standing >= STUCK, {}

    def _forward(self, rows: Array) -> Array:
        """Return the forward velocities, m/s."""
        heading = headings(rows[:, 6:10])
        return np.asarray(rows[:, 10] * np.cos(heading) + rows[:, 11] * np.sin(heading))
