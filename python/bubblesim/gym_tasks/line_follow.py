# SPDX-License-Identifier: BSD-3-Clause
"""LineFollow: follow a line on the floor with a camera."""

from __future__ import annotations

from typing import ClassVar

import numpy as np
from gymnasium import spaces

import bubblesim
from bubblesim.gym_tasks.task import SCENES, Array, Task, upright

WIDTH, HEIGHT = 32, 24  # pixels
TRACK, WHEEL = 0.33, 0.0975  # m
SPEED, TURN = 0.5, 1.5  # m/s, rad/s of the actions 1
LOST = 0.35  # m from the line


def line(angles: Array) -> Array:
    """Return the points of the line at angles around its middle, rad."""
    radius = 2 + 0.4 * np.sin(3 * angles)
    return np.asarray(np.column_stack([radius * np.cos(angles), radius * np.sin(angles)]))


LINE = line(np.linspace(0.0, 2 * np.pi, 720, endpoint=False))


class LineFollow(Task):
    """Actions: forward velocity (from 0 to 0.5 m/s) and turn rate (from -1.5 to 1.5 rad/s), as -1 to 1, for 0.05 s.

    Observation: the image of a camera that looks at the floor ahead, 24 x 32 x 3.
    Reward: metres driven along the line, less 0.02 of the distance from it in each step. The episode ends 0.35 m off.
    """

    scene: ClassVar[str] = str(SCENES / "line_follow.sdf")
    actions: ClassVar = ["/LeftMotor.target_velocity", "/RightMotor.target_velocity"]
    observations: ClassVar = ["/Camera.image", "/Pioneer.pose"]
    action_space = spaces.Box(-1.0, 1.0, (2,), np.float32)
    observation_space = spaces.Box(0, 255, (HEIGHT, WIDTH, 3), np.uint8)

    def __init__(self, worlds: int) -> None:
        """Make the rules."""
        super().__init__(worlds)
        self._nearest: Array = np.zeros(worlds, dtype=int)  # point of the line

    def place(self, world: int, simulation: bubblesim.Simulation, random: np.random.Generator) -> None:
        """Draw a place on the line, up to 5 cm and 0.3 rad off, in its direction."""
        index = int(random.integers(len(LINE)))
        along = LINE[(index + 1) % len(LINE)] - LINE[index]
        robot = simulation.object("/Pioneer")
        robot.position = [*(LINE[index] + random.uniform(-0.05, 0.05, 2)), 0.0]
        robot.orientation = upright(np.arctan2(along[1], along[0]) + random.uniform(-0.3, 0.3))

    def begin(self, marks: Array, rows: Array) -> None:
        """Remember the first places on the line."""
        self._nearest = np.where(marks, self._found(rows)[0], self._nearest)

    def commands(self, actions: Array) -> Array:
        """Return the wheel speeds, rad/s."""
        wanted = np.clip(actions, -1.0, 1.0).astype(np.float64)
        forward, across = SPEED * (wanted[:, 0] + 1) / 2, TURN * wanted[:, 1] * TRACK / 2
        return np.column_stack([forward - across, forward + across]) / WHEEL

    def observe(self, rows: Array) -> Array:
        """Return the images."""
        return rows[:, : HEIGHT * WIDTH * 3]

    def judge(self, rows: Array) -> tuple[Array, Array, dict[str, Array]]:
        """Return the progress along the line."""
        nearest, away = self._found(rows)
        half = len(LINE) // 2
        steps = (nearest - self._nearest + half) % len(LINE) - half
        length = np.hypot(*np.diff(LINE, axis=0, append=LINE[:1]).T)
        self._nearest = nearest
        return steps * length[nearest] - 0.02 * away, away > LOST, {"distance": away}

    def _found(self, rows: Array) -> tuple[Array, Array]:
        """Return the nearest points of the line, and their distances, m."""
        start = HEIGHT * WIDTH * 3
        away = np.hypot(*(rows[:, None, start : start + 2] - LINE).transpose(2, 0, 1))
        return away.argmin(axis=1), away.min(axis=1)
