# SPDX-License-Identifier: BSD-3-Clause
"""The tasks as Gymnasium environments."""

import math
import warnings

import numpy as np
import pytest

gymnasium = pytest.importorskip("gymnasium")

from gymnasium.utils.env_checker import check_env  # noqa: E402

from bubblesim.gym_tasks.bubblerob_maze import PATH, path_left  # noqa: E402
from bubblesim.gym_tasks.cartpole import place_state  # noqa: E402
from bubblesim.gym_tasks.environment import TaskEnv  # noqa: E402
from bubblesim.gym_tasks.pioneer_goal import PioneerGoal  # noqa: E402

TASKS = ["BubbleRobMaze", "CartPole", "LineFollow", "PioneerGoal", "TricycleAvoid"]


def make(task: str, **options: object) -> "gymnasium.Env":
    return gymnasium.make(f"bubblesim/{task}-v0", **options)


def rollout(env: "gymnasium.Env", seed: int, steps: int = 60) -> list[object]:
    """Return all that an episode with random actions shows."""
    env.action_space.seed(seed)
    seen = [env.reset(seed=seed)[0].tolist()]
    for _ in range(steps):
        observation, reward, terminated, truncated, _ = env.step(env.action_space.sample())
        seen += [observation.tolist(), reward, terminated]
        if terminated or truncated:
            break
    return seen


def test_importing_the_package_registers_all_tasks() -> None:
    names = {name for name in gymnasium.registry if name.startswith("bubblesim/")}
    assert names == {f"bubblesim/{task}-v0" for task in TASKS}


@pytest.mark.parametrize("task", TASKS)
def test_gymnasium_finds_no_fault(task: str) -> None:
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        warnings.filterwarnings("ignore", message=".*Box observation space m.*imum value is.*infinity")
        check_env(make(task, render_mode="rgb_array").unwrapped)


@pytest.mark.parametrize("task", TASKS)
def test_stable_baselines_finds_no_fault(task: str) -> None:
    checker = pytest.importorskip("stable_baselines3.common.env_checker")
    checker.check_env(make(task))


@pytest.mark.parametrize("task", TASKS)
def test_equal_seeds_give_equal_episodes(task: str) -> None:
    env = make(task)
    first = rollout(env, 1)
    assert rollout(env, 2)[0] != first[0]
    assert rollout(env, 1) == first == rollout(make(task), 1)


@pytest.mark.parametrize("task", TASKS)
def test_pictures_show_the_world(task: str) -> None:
    env = make(task, render_mode="rgb_array")
    env.reset(seed=0)
    picture = env.render()
    assert picture.dtype == np.uint8
    assert picture.ndim == 3
    assert picture.std() > 5.0  # not of one colour


class LatePioneer(PioneerGoal):
    action_delay = 2
    observation_delay = 3


def test_actions_act_and_observations_come_after_their_delays() -> None:
    prompt, late = TaskEnv(PioneerGoal), TaskEnv(LatePioneer)
    rng = np.random.default_rng(0)
    actions = [rng.uniform(-1, 1, 2).astype(np.float32) for _ in range(12)]
    still = [np.zeros(2, np.float32)] * LatePioneer.action_delay
    seen = [prompt.reset(seed=3)[0], *(prompt.step(action)[0] for action in [*still, *actions])]
    shown = [late.reset(seed=3)[0], *(late.step(action)[0] for action in actions)]
    for step, observation in enumerate(shown):
        np.testing.assert_array_equal(observation, seen[max(0, step - LatePioneer.observation_delay)])


def test_an_unknown_render_mode_is_refused() -> None:
    with pytest.raises(ValueError, match="render_mode is 'ansi'"):
        TaskEnv("bubblesim.gym_tasks.cartpole:CartPole", render_mode="ansi")


@pytest.mark.parametrize("angle", [0.0, 0.1, -0.15])
def test_the_cart_and_the_pole_move_as_in_gymnasium(angle: float) -> None:
    ours, theirs = make("CartPole").unwrapped, gymnasium.make("CartPole-v1").unwrapped
    ours.reset(seed=0)
    theirs.reset(seed=0)
    state = np.array([0.1, -0.2, angle, 0.3])
    place_state(ours.simulation, state)
    theirs.tau, steps = 0.0002, 100  # its explicit Euler steps, refined: the equations themselves
    theirs.state = state
    for step in range(25):
        action = int(step % 7 < 4)
        observation, *_ = ours.step(action)
        for _ in range(steps):
            theirs.step(action)
            theirs.steps_beyond_terminated = None
    assert observation == pytest.approx(np.array(theirs.state), abs=0.01)


def test_a_pole_that_falls_ends_the_episode() -> None:
    env = make("CartPole")
    env.reset(seed=0)
    for _ in range(20):
        observation, reward, terminated, _, _ = env.step(1)
        assert reward == 1.0
        if terminated:
            break
    assert terminated
    assert abs(observation[2]) > math.radians(12)


def test_the_pioneer_gets_its_reward_at_the_goal_and_for_touching() -> None:
    env = make("PioneerGoal")
    ends = set()
    for seed in range(40):
        seen, _ = env.reset(seed=seed)
        first = 10.0 * seen[24]
        total, steps = 0.0, 0
        while True:
            bearing = math.atan2(seen[26], seen[25])
            action = np.array([0.8 if abs(bearing) < 0.5 else 0.0, np.clip(2 * bearing, -1, 1)], np.float32)
            seen, reward, terminated, truncated, info = env.step(action)
            total, steps = total + reward, steps + 1
            if terminated or truncated:
                break
        if not terminated:
            continue
        ends.add(bool(info["success"]))
        progress = first - 10.0 * seen[24]
        end = 10.0 if info["success"] else -10.0
        assert total == pytest.approx(progress - 0.02 * steps + end, abs=1e-3)
        if ends == {True, False}:
            return
    pytest.fail(f"only these ends: {ends}")


def test_the_way_through_the_maze_gets_shorter() -> None:
    lengths = path_left(np.linspace(PATH[:-1], PATH[1:], 20).transpose(1, 0, 2).reshape(-1, 2))
    assert (np.diff(lengths) <= 1e-9).all()
    assert lengths[-1] == pytest.approx(0.0)
    assert path_left(np.array([[-1.0, 1.0]])) == pytest.approx([lengths[0] + 1.0])


def test_bubblerob_can_leave_the_maze() -> None:
    env = make("BubbleRobMaze")
    seen, _ = env.reset(seed=0)
    target = 0
    for _ in range(800):
        x, y, cosine, sine = seen[1:]
        if math.dist((x, y), PATH[target]) < 0.15 and target < len(PATH) - 1:
            target += 1
        wanted = math.atan2(PATH[target][1] - y, PATH[target][0] - x) - math.atan2(sine, cosine)
        wanted = math.remainder(wanted, math.tau)
        speed = 1.0 if abs(wanted) < 0.5 else 0.0
        turn = np.clip(wanted, -0.6, 0.6)
        seen, _, terminated, _, info = env.step(np.array([speed * 0.8 - turn, speed * 0.8 + turn], np.float32))
        if terminated:
            break
    assert info["success"]


def test_the_line_can_be_followed_by_its_image() -> None:
    env = make("LineFollow")
    image, _ = env.reset(seed=1)
    total = 0.0
    for _ in range(200):
        dark = 255.0 - image[4:20].mean(axis=2)
        dark[dark < 120] = 0.0
        middle = (dark.sum(axis=0) @ np.arange(32)) / max(dark.sum(), 1.0) if dark.sum() else 15.5
        image, reward, terminated, _, info = env.step(np.array([0.0, (15.5 - middle) / 8.0], np.float32))
        total += reward
        assert not terminated
    assert total > 1.5  # of 2.5 m at 0.25 m/s for 10 s
    assert info["distance"] < 0.2


def test_a_tricycle_that_stands_ends_the_episode() -> None:
    env = make("TricycleAvoid")
    env.reset(seed=0)
    rewards = []
    for _ in range(60):
        _, reward, terminated, _, _ = env.step(np.array([0.0, -1.0], np.float32))
        rewards.append(reward)
        if terminated:
            break
    assert terminated
    assert sum(rewards) == pytest.approx(0.0, abs=0.05)
