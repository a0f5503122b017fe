# SPDX-License-Identifier: BSD-3-Clause
"""Many worlds of a task as a Gymnasium vector environment, with the three ways to begin the next episode."""

from __future__ import annotations

from typing import Any

import gymnasium
import numpy as np
from gymnasium.vector import AutoresetMode, VectorEnv
from gymnasium.vector.utils import batch_space

from bubblesim.gym_tasks.task import Array, Task
from bubblesim.gym_tasks.worlds import Worlds


class TaskVectorEnv(VectorEnv[Any, Any, Array]):
    """World i has the episodes of a single environment with the seed of this one plus i."""

    metadata: dict[str, Any] = {  # noqa: RUF012  # Gymnasium declares it so
        "render_modes": ["rgb_array"],
        "render_fps": 20,
    }

    def __init__(
        self,
        task: str | type[Task],
        num_envs: int = 1,
        max_episode_steps: int | None = None,
        render_mode: str | None = None,
        autoreset_mode: str | AutoresetMode = AutoresetMode.NEXT_STEP,
        threads: int | None = None,
    ) -> None:
        """Load the task's scene and make the worlds.

        :param max_episode_steps: after which episodes are truncated; None: never.
        :param autoreset_mode: NextStep: the step after the end of an episode resets; SameStep: the step that ends it
            does, with the last observation in ``info["final_obs"]``; Disabled: ``reset`` with
            ``options={"reset_mask": mask}``.
        :param threads: that step the worlds; None: as many as the process may use cores.
        """
        self.num_envs = num_envs
        self.render_mode = render_mode
        self.autoreset_mode = AutoresetMode(autoreset_mode)
        self._worlds = Worlds(task, num_envs, threads)
        self.single_observation_space = self._worlds.task.observation_space
        self.single_action_space = self._worlds.task.action_space
        self.observation_space = batch_space(self.single_observation_space, num_envs)
        self.action_space = batch_space(self.single_action_space, num_envs)
        self.metadata = {
            **self.metadata,
            "render_fps": round(1.0 / self._worlds.step_seconds),
            "autoreset_mode": self.autoreset_mode,
        }
        self._most_steps = max_episode_steps
        self._elapsed = np.zeros(num_envs, dtype=int)
        self._ended: Array = np.zeros(num_envs, dtype=bool)
        self._random: list[np.random.Generator] = []

    def reset(
        self, *, seed: int | list[int | None] | None = None, options: dict[str, Any] | None = None
    ) -> tuple[Any, dict[str, Any]]:
        """Begin episodes: in all worlds, or in those of ``options["reset_mask"]``."""
        mask = (options or {}).get("reset_mask")
        marks = np.ones(self.num_envs, dtype=bool) if mask is None else np.asarray(mask, dtype=bool)
        if marks.shape != (self.num_envs,) or not marks.any():
            raise ValueError(f"reset_mask must have {self.num_envs} values, at least one of them true")
        self._seed(seed, marks)
        return self._begin(marks), {}

    def step(self, actions: Any) -> tuple[Any, Array, Array, Array, dict[str, Any]]:
        """Carry out an action in each world."""
        before = self._ended
        if self.autoreset_mode == AutoresetMode.DISABLED and before.any():
            raise RuntimeError(f"the episodes of worlds {np.flatnonzero(before).tolist()} have ended: reset them")
        observations, rewards, terminated, facts = self._worlds.step(np.asarray(actions))
        self._elapsed += 1
        truncated = ~terminated & (self._elapsed >= (self._most_steps or np.iinfo(int).max))
        info = self._info(facts, ~before)
        if before.any():  # in the mode NEXT_STEP: this step begins their next episodes
            observations = self._begin(before)
            rewards = np.where(before, 0.0, rewards)
            terminated, truncated = terminated & ~before, truncated & ~before
        self._ended = terminated | truncated
        if self.autoreset_mode == AutoresetMode.SAME_STEP and self._ended.any():
            ended = self._ended
            final = np.empty(self.num_envs, dtype=object)
            for world in np.flatnonzero(ended):
                final[world] = observations[world].copy()
            info = {"final_obs": final, "_final_obs": ended, "final_info": info, "_final_info": ended}
            observations = self._begin(ended)
            self._ended = np.zeros(self.num_envs, dtype=bool)
        return observations.copy(), rewards.astype(np.float64), terminated, truncated, info

    def render(self) -> tuple[Array, ...] | None:  # type: ignore[override]
        """Return an image of each world if `render_mode` is rgb_array."""
        if self.render_mode != "rgb_array":
            return None
        return tuple(self._worlds.picture(world) for world in range(self.num_envs))

    def _seed(self, seed: int | list[int | None] | None, marks: Array) -> None:
        if seed is None and self._random:
            return
        first = [None] * self.num_envs if seed is None else seed
        seeds = [first + world for world in range(self.num_envs)] if isinstance(first, int) else list(first)
        if len(seeds) != self.num_envs:
            raise ValueError(f"there must be a seed for each of the {self.num_envs} worlds, found {len(seeds)}")
        old = self._random or [np.random.default_rng() for _ in seeds]
        self._random = [
            gymnasium.utils.seeding.np_random(number)[0] if marks[world] and number is not None else old[world]
            for world, number in enumerate(seeds)
        ]

    def _begin(self, marks: Array) -> Array:
        self._elapsed[marks] = 0
        self._ended = self._ended & ~marks
        return self._worlds.reset({int(world): self._random[world] for world in np.flatnonzero(marks)}).copy()

    def _info(self, facts: dict[str, Array], valid: Array) -> dict[str, Any]:
        return {key: value for name, values in facts.items() for key, value in ((name, values), (f"_{name}", valid))}
