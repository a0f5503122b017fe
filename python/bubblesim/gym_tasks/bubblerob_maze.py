# SPDX-License-Identifier: BSD-3-Clause
"""BubbleRobMaze: leave a small maze."""

from __future__ import annotations

from typing import ClassVar

import numpy as np
from gymnasium import spaces

import bubblesim
from bubblesim.gym_tasks.task import SCENES, Array, Task, headings, upright

SPEED = 6.0  # rad/s of a wheel of radius 0.04 m: actions 1
NOSE = 0.2  # m, range of the nose's sensor
PATH = np.array([[-1.0, 0.0], [-0.5, -1.05], [0.0, 0.0], [0.5, 1.05], [1.5, 1.05], [2.2, 1.05]])  # m, through the maze
OUT = 1.75  # m along x: outside


class BubbleRobMaze(Task):
    """Actions: speeds of the left and the right wheel (from -6 to 6 rad/s), as -1 to 1, for 0.05 s.

    Observation: distance measured by the nose as a fraction of 0.2 m, position (m), cosine and sine of the heading.
    Reward: the metres by which the way to the exit, through the middle of the gaps, has become shorter, and 5 outside,
    where the episode ends with `success`.
    """

    scene: ClassVar[str] = str(SCENES / "bubblerob_maze.sdf")
    actions: ClassVar = [
        "/rosInterfaceControlledBubbleRobLeftMotor.target_velocity",
        "/rosInterfaceControlledBubbleRobRightMotor.target_velocity",
    ]
    observations: ClassVar = [
        "/rosInterfaceControlledBubbleRobSensingNose.detected",
        "/rosInterfaceControlledBubbleRobSensingNose.distance",
        "/BubbleRob.pose",
    ]
    action_space = spaces.Box(-1.0, 1.0, (2,), np.float32)
    observation_space = spaces.Box(np.array([0, -3, -3, -1, -1], np.float32), np.array([1, 3, 3, 1, 1], np.float32))

    def __init__(self, worlds: int) -> None:
        """Make the rules."""
        super().__init__(worlds)
        self._left: Array = np.zeros(worlds)  # m to the exit

    def place(self, world: int, simulation: bubblesim.Simulation, random: np.random.Generator) -> None:
        """Draw a start in the first passage."""
        robot = simulation.object("/BubbleRob")
        robot.position = [*random.uniform([-1.15, 0.0], [-0.95, 1.1]), 0.0]
        robot.orientation = upright(random.uniform(-np.pi, np.pi))

    def begin(self, marks: Array, rows: Array) -> None:
        """Remember the first lengths of the way."""
        self._left = np.where(marks, path_left(rows[:, 2:4]), self._left)

    def commands(self, actions: Array) -> Array:
        """Return the wheel speeds, rad/s."""
        return SPEED * np.clip(actions, -1.0, 1.0).astype(np.float64)

    def observe(self, rows: Array) -> Array:
        """Return distance, position and heading."""
        heading = headings(rows[:, 5:9])
        near = np.where(rows[:, 0] > 0, rows[:, 1], NOSE) / NOSE
        return np.column_stack([near, rows[:, 2:4], np.cos(heading), np.sin(heading)])

    def judge(self, rows: Array) -> tuple[Array, Array, dict[str, Array]]:
        """Return the progress on the way."""
        left = path_left(rows[:, 2:4])
        success = rows[:, 2] > OUT
        rewards = self._left - left + 5.0 * success
        self._left = left
        return rewards, success, {"success": success}


def path_left(points: Array) -> Array:
    """Return the path length to the exit from the closest point of the path, and the distance to that point, m."""
    starts, ends = PATH[:-1], PATH[1:]
    spans = ends - starts
    lengths = np.hypot(*spans.T)
    share = (((points[:, None] - starts) * spans).sum(axis=2) / lengths**2).clip(0.0, 1.0)
    away = np.linalg.norm(points[:, None] - (starts + share[..., None] * spans), axis=2)
    beyond = np.append(np.cumsum(lengths[::-1])[::-1][1:], 0.0)
    nearest = away.argmin(axis=1)
    rows = np.arange(len(points))
    return np.asarray(away[rows, nearest] + (1 - share[rows, nearest]) * lengths[nearest] + beyond[nearest])
