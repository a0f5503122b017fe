# SPDX-License-Identifier: BSD-3-Clause
"""Many worlds of a task: they equal single environments, in all modes of beginning the next episode."""

from typing import ClassVar

import numpy as np
import pytest

import bubblesim

gymnasium = pytest.importorskip("gymnasium")

from gymnasium import spaces  # noqa: E402
from gymnasium.vector import AutoresetMode  # noqa: E402

from bubblesim.gym_tasks.task import Array, Task  # noqa: E402
from bubblesim.gym_tasks.vector_environment import TaskVectorEnv  # noqa: E402

NAME = "bubblesim/CartPole-v0"


def make_vec(count: int = 3, **options: object) -> "gymnasium.vector.VectorEnv":
    return gymnasium.make_vec(NAME, num_envs=count, vectorization_mode="vector_entry_point", **options)


@pytest.mark.parametrize("mode", list(AutoresetMode))
@pytest.mark.parametrize("name", [NAME, "bubblesim/PioneerGoal-v0"])
def test_each_world_equals_a_single_environment(mode: AutoresetMode, name: str) -> None:
    worlds = gymnasium.make_vec(name, num_envs=3, vectorization_mode="vector_entry_point", autoreset_mode=mode)
    singles = [gymnasium.make(name) for _ in range(3)]
    assert worlds.metadata["autoreset_mode"] == mode
    observations, _ = worlds.reset(seed=5)
    for i, single in enumerate(singles):
        assert single.reset(seed=5 + i)[0].tolist() == observations[i].tolist()
    ended = np.zeros(3, dtype=bool)
    worlds.action_space.seed(1)
    for _ in range(80):
        actions = worlds.action_space.sample()
        if mode == AutoresetMode.DISABLED and ended.any():
            observations, _ = worlds.reset(options={"reset_mask": ended})
            for i in np.flatnonzero(ended):
                assert singles[i].reset()[0].tolist() == observations[i].tolist()
            ended[:] = False
        observations, rewards, terminated, truncated, info = worlds.step(actions)
        for i, single in enumerate(singles):
            if mode == AutoresetMode.NEXT_STEP and ended[i]:
                assert single.reset()[0].tolist() == observations[i].tolist()
                assert (rewards[i], terminated[i], truncated[i]) == (0.0, False, False)
                continue
            observation, reward, end, _, _ = single.step(actions[i])
            assert (reward, end) == (rewards[i], terminated[i])
            if mode == AutoresetMode.SAME_STEP and end:
                assert info["final_obs"][i].tolist() == observation.tolist()
                observation = single.reset()[0]
            assert observation.tolist() == observations[i].tolist()
        ended = (terminated | truncated) & (mode != AutoresetMode.SAME_STEP)


def test_episodes_are_truncated() -> None:
    worlds = make_vec(max_episode_steps=5)
    worlds.reset(seed=0)
    for step in range(5):
        *_, terminated, truncated, _ = worlds.step(np.array([0, 1, step % 2]))
        assert truncated.tolist() == [step == 4] * 3
        assert not terminated.any()


def test_worlds_whose_episodes_ended_must_be_reset_in_the_mode_disabled() -> None:
    worlds = make_vec(max_episode_steps=2, autoreset_mode=AutoresetMode.DISABLED)
    worlds.reset(seed=0)
    worlds.step(np.zeros(3, int))
    worlds.step(np.zeros(3, int))
    with pytest.raises(RuntimeError, match=r"worlds \[0, 1, 2\] have ended"):
        worlds.step(np.zeros(3, int))
    worlds.reset(options={"reset_mask": np.array([True, True, False])})
    with pytest.raises(RuntimeError, match=r"worlds \[2\]"):
        worlds.step(np.zeros(3, int))


def test_bad_masks_and_seeds_are_refused() -> None:
    worlds = make_vec()
    with pytest.raises(ValueError, match="reset_mask must have 3"):
        worlds.reset(options={"reset_mask": np.array([True])})
    with pytest.raises(ValueError, match="a seed for each of the 3"):
        worlds.reset(seed=[1, 2])


def test_a_seed_for_each_world() -> None:
    worlds = make_vec()
    first, _ = worlds.reset(seed=[7, 8, 7])
    assert first[0].tolist() == first[2].tolist() != first[1].tolist()


def test_each_world_has_a_picture() -> None:
    worlds = make_vec(2, render_mode="rgb_array")
    worlds.reset(seed=0)
    pictures = worlds.render()
    assert [picture.shape for picture in pictures] == [(320, 480, 3)] * 2
    assert (pictures[0] != pictures[1]).any()


class Leaving(Task):
    """A ball that may be shot out of the world; its mass is drawn."""

    scene = "ball"
    actions = ("/Ball.velocity",)
    observations = ("/Ball.mass", "/Ball.position")
    randomize: ClassVar = {"/Ball.mass": bubblesim.Distribution.uniform(1.0, 2.0)}
    action_space = spaces.Box(0.0, 1.0, (1,), np.float32)
    observation_space = spaces.Box(-1e9, 1e9, (4,), np.float64)

    def place(self, world: int, simulation: bubblesim.Simulation, random: np.random.Generator) -> None:
        """Leave it where it is."""

    def commands(self, actions: Array) -> Array:
        """Return the velocity."""
        return 9e5 * actions * [0, 0, 1, 0, 0, 0]

    def observe(self, rows: Array) -> Array:
        """Return all."""
        return rows

    def judge(self, rows: Array) -> tuple[Array, Array, dict[str, Array]]:
        """Return 1 for each step."""
        return np.ones(len(rows)), np.zeros(len(rows), dtype=bool), {}


def test_the_episode_of_a_world_that_diverges_ends() -> None:
    worlds = TaskVectorEnv(Leaving, 2, threads=2)
    first, _ = worlds.reset(seed=0)
    assert first[0, 0] != first[1, 0]
    for _ in range(50):
        _, rewards, terminated, *_ = worlds.step(np.array([[0.0], [1.0]]))
        if terminated.any():
            break
    assert terminated.tolist() == [False, True]
    assert rewards.tolist() == [1.0, 0.0]
    worlds.step(np.array([[0.0], [0.0]]))
    assert (worlds.reset(seed=0)[0][:, 0] == first[:, 0]).all()
