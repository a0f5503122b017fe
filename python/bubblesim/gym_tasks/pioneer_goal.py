# SPDX-License-Identifier: BSD-3-Clause
"""PioneerGoal: reach a goal among random obstacles, with a lidar."""

from __future__ import annotations

from typing import ClassVar

import numpy as np
from gymnasium import spaces

import bubblesim
from bubblesim.gym_tasks.task import SCENES, Array, Task, headings, upright

RAYS = 24
RANGE = 4.0  # m, of the lidar
TRACK, WHEEL = 0.33, 0.0975  # m
SPEED, TURN = 0.8, 1.6  # m/s, rad/s of the actions 1
OBSTACLES = 8
REACHED = 0.4  # m
HALF = 4.0  # m, half the side in which things are placed
APART = 1.1  # m, between obstacles and from them to start and goal


class PioneerGoal(Task):
    """Actions: forward velocity (from -0.8 to 0.8 m/s) and turn rate (from -1.6 to 1.6 rad/s), as -1 to 1, for 0.2 s.

    Observation: 24 lidar ranges over 270 degrees from the right to the left, as fractions of 4 m; distance to the goal
    as a fraction of 10 m; cosine and sine of its direction; forward velocity (m/s) and turn rate (rad/s).
    Reward: the metres by which the goal has come nearer, -0.02 for each step, 10 at the goal, -10 for touching an
    obstacle or a wall; both end the episode. The information `success` is true at the goal.
    """

    scene: ClassVar[str] = str(SCENES / "pioneer_goal.sdf")
    actions: ClassVar = ["/LeftMotor.target_velocity", "/RightMotor.target_velocity"]
    observations: ClassVar = ["/Lidar.ranges", "/Pioneer.pose", "/Pioneer.velocity", "/Bumper.contacts"]
    action_space = spaces.Box(-1.0, 1.0, (2,), np.float32)
    observation_space = spaces.Box(
        np.array([0.0] * RAYS + [0.0, -1.0, -1.0, -3.0, -6.0], np.float32),
        np.array([1.0] * RAYS + [2.0, 1.0, 1.0, 3.0, 6.0], np.float32),
    )

    def __init__(self, worlds: int) -> None:
        """Make the rules."""
        super().__init__(worlds)
        self.goals = np.zeros((worlds, 2))
        self._distances: Array = np.zeros(worlds)

    def place(self, world: int, simulation: bubblesim.Simulation, random: np.random.Generator) -> None:
        """Draw start, goal (at least 4 m away) and obstacles."""
        while True:
            start, goal = random.uniform(-HALF, HALF, (2, 2))
            if np.hypot(*(goal - start)) >= 4.0:
                break
        taken = [start, goal]
        for number in range(OBSTACLES):
            for _ in range(100):
                point = random.uniform(-HALF, HALF, 2)
                if min(np.hypot(*(point - other)) for other in taken) >= APART:
                    break
            else:
                point = np.array([HALF + 1.0 + number, HALF + 2.0])  # outside the walls
            taken.append(point)
            simulation.object(f"/Obstacle{number}").position = [*point, 0.5]
        robot = simulation.object("/Pioneer")
        robot.position = [*start, 0.0]
        robot.orientation = upright(random.uniform(-np.pi, np.pi))
        simulation.object("/Goal").position = [*goal, 0.0]
        self.goals[world] = goal

    def begin(self, marks: Array, rows: Array) -> None:
        """Remember the first distances to the goals."""
        self._distances = np.where(marks, self._goal_seen(rows)[0], self._distances)

    def commands(self, actions: Array) -> Array:
        """Return the wheel speeds, rad/s."""
        wanted = np.clip(actions, -1.0, 1.0).astype(np.float64)
        forward, across = SPEED * wanted[:, 0], TURN * wanted[:, 1] * TRACK / 2
        return np.column_stack([forward - across, forward + across]) / WHEEL

    def observe(self, rows: Array) -> Array:
        """Return ranges, direction of the goal and velocities."""
        distances, bearings = self._goal_seen(rows)
        heading = headings(rows[:, RAYS + 3 : RAYS + 7])
        velocity = rows[:, RAYS + 7 : RAYS + 13]
        forward = velocity[:, 0] * np.cos(heading) + velocity[:, 1] * np.sin(heading)
        seen = np.minimum(rows[:, :RAYS], RANGE) / RANGE
        return np.column_stack([seen, distances / 10.0, np.cos(bearings), np.sin(bearings), forward, velocity[:, 5]])

    def judge(self, rows: Array) -> tuple[Array, Array, dict[str, Array]]:
        """Return the progress as the reward, and 10 more at the goal, 10 less at a collision."""
        distances, _ = self._goal_seen(rows)
        success = distances < REACHED
        collision = (rows[:, RAYS + 13] > 0) & ~success
        rewards = self._distances - distances - 0.02 + 10.0 * success - 10.0 * collision
        self._distances = distances
        return rewards, success | collision, {"success": success}

    def _goal_seen(self, rows: Array) -> tuple[Array, Array]:
        """Return distances to the goals and their directions from the robots' headings, rad."""
        offsets = self.goals - rows[:, RAYS : RAYS + 2]
        return np.hypot(*offsets.T), np.arctan2(offsets[:, 1], offsets[:, 0]) - headings(rows[:, RAYS + 3 : RAYS + 7])
