# SPDX-License-Identifier: BSD-3-Clause
"""The worlds of a task: their simulations, commands and observations."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np

import bubblesim
from bubblesim.gym_tasks.task import Array, Task, make_task
from bubblesim.learning.delayed_rows import DelayedRows


class Worlds:
    """Some worlds that threads in C++ step together."""

    def __init__(self, task: str | type[Task], count: int, threads: int | None = None) -> None:
        """Load the scene once, and make the worlds.

        :param threads: None: as many as the process may use cores, one for a single world.
        """
        self.task = make_task(task, count)
        self._batch = bubblesim.Batch(
            bubblesim.Scene(self.task.scene),
            count,
            threads=1 if count == 1 else threads,
            actions=list(self.task.actions),
            observations=list(self.task.observations),
            dtype="float64",
            randomize=dict(self.task.randomize),
        )
        self._commands = DelayedRows(count, self.task.action_delay, name="action_delay")
        self._observed = DelayedRows(count, self.task.observation_delay, name="observation_delay")
        self.step_seconds = self._batch[0].time_step * self.task.steps

    def reset(self, random: Mapping[int, np.random.Generator]) -> Array:
        """Begin episodes in some worlds, with their random numbers; return the observations of all worlds."""
        count = len(self._batch)
        marks = np.zeros(count, dtype=bool)
        marks[list(random)] = True
        seeds = np.zeros(count, dtype=np.uint64)
        for world, generator in random.items():
            seeds[world] = generator.integers(2**63)
        self._batch.reset(marks, seeds)  # also draws what the task randomizes
        for world, generator in random.items():
            self.task.place(world, self._batch[world], generator)
            self._batch[world].step()  # settles, and the sensors measure at the new places
        rows = self._batch.observe()
        self.task.begin(marks, rows)
        width = sum(quantity.size for quantity in self._batch.actions)
        self._commands.restart(np.zeros((count, width)), seeds, marks)  # motors stand until the first action acts
        self._observed.restart(self._checked(self.task.observe(rows)), seeds, marks)
        return self._observed.last()

    def step(self, actions: Array) -> tuple[Array, Array, Array, dict[str, Array]]:
        """Carry out an action in each world; return observations, rewards, ends and information.

        The episode of a world that diverged or lost a model ends without a reward.
        """
        rows = self._batch.step(self._commands(self.task.commands(actions)), self.task.steps)
        rewards, terminated, info = self.task.judge(rows)
        failed = self._batch.failed
        rewards = np.where(failed, 0.0, rewards)
        return self._observed(self._checked(self.task.observe(rows))), rewards, terminated | failed, info

    def picture(self, world: int) -> Array:
        """Return an image of a world."""
        from bubblesim import _core

        simulation = self._batch[world]
        camera = simulation.object(self.task.camera).handle
        return np.array(_core.measure_camera(simulation, camera).rgb)

    def simulation(self, world: int) -> bubblesim.Simulation:
        """Return the simulation of a world."""
        return self._batch[world]

    def _checked(self, observations: Any) -> Array:
        space = self.task.observation_space
        shaped = observations.reshape(-1, *space.shape)
        return np.asarray(np.clip(shaped, space.low, space.high), dtype=space.dtype)
