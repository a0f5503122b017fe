# SPDX-License-Identifier: BSD-3-Clause
"""A task as a Gymnasium environment."""

from __future__ import annotations

from typing import Any

import gymnasium

from bubblesim.gym_tasks.task import Array, Task
from bubblesim.gym_tasks.worlds import Worlds


class TaskEnv(gymnasium.Env[Any, Any]):
    """One world of a task."""

    metadata: dict[str, Any] = {  # noqa: RUF012  # Gymnasium declares it so
        "render_modes": ["rgb_array"],
        "render_fps": 20,
    }

    def __init__(self, task: str | type[Task], render_mode: str | None = None) -> None:
        """Load the task's scene."""
        if render_mode not in (None, *self.metadata["render_modes"]):
            raise ValueError(f"render_mode is {render_mode!r}; there are {self.metadata['render_modes']} and None")
        self.render_mode = render_mode
        self._worlds = Worlds(task, 1)
        self.observation_space = self._worlds.task.observation_space
        self.action_space = self._worlds.task.action_space
        self.metadata = {**self.metadata, "render_fps": round(1.0 / self._worlds.step_seconds)}

    def reset(self, *, seed: int | None = None, options: dict[str, Any] | None = None) -> tuple[Any, dict[str, Any]]:
        """Begin an episode; equal seeds give equal episodes."""
        super().reset(seed=seed)
        observations = self._worlds.reset({0: self.np_random})
        return observations[0].copy(), {}

    def step(self, action: Any) -> tuple[Any, float, bool, bool, dict[str, Any]]:
        """Carry out an action."""
        observations, rewards, terminated, info = self._worlds.step(self._in_row(action))
        facts = {name: values[0].item() for name, values in info.items()}
        return observations[0].copy(), float(rewards[0]), bool(terminated[0]), False, facts

    def render(self) -> Array | None:  # type: ignore[override]
        """Return the image of the scene's camera, height x width x 3, if `render_mode` is rgb_array."""
        return self._worlds.picture(0) if self.render_mode == "rgb_array" else None

    @property
    def simulation(self) -> Any:
        """Return the bubblesim.Simulation of the world."""
        return self._worlds.simulation(0)

    def _in_row(self, action: Any) -> Array:
        import numpy as np

        return np.asarray(action)[None]
