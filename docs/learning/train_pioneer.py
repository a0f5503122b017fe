# SPDX-License-Identifier: BSD-3-Clause
"""Train bubblesim/PioneerGoal-v0 by augmented random search (Mania, Guy, Recht 2018) with numpy alone.

    python docs/learning/train_pioneer.py [--iterations 40] [--processes 2] [--output FOLDER]

Writes policy.npy, curve.png and paths.png. Seeds from 1,000,000 on are held out for the evaluation.
"""

import argparse
import multiprocessing
import os
import time
from pathlib import Path

import gymnasium
import matplotlib as mpl
import numpy as np

import bubblesim.gym_tasks  # noqa: F401  # registers the environment

mpl.use("Agg")

from matplotlib import pyplot as plt

DIRECTIONS, BEST, EPISODES = 12, 6, 6  # random directions, those that are used, episodes of each policy
STEP, NOISE = 0.15, 0.12  # of the parameters; the step decreases to 0
HELD_OUT = 1_000_000
RAYS = 24
PARAMETERS = (RAYS // 2 + 2) + (RAYS // 2 + 5)


def action(parameters: np.ndarray, seen: np.ndarray) -> np.ndarray:
    """Return the action of a policy that is linear in features, and mirrored when the world is.

    The turn is odd under a mirror, the velocity even: differences and sums of the rays to both sides.
    """
    near = (1.0 - seen[:RAYS]) ** 3
    right, left = near[: RAYS // 2], near[: RAYS // 2 - 1 : -1]
    distance, cosine, sine, forward, turning = seen[RAYS:]
    direction = np.arctan2(sine, cosine)
    odd = np.concatenate([right - left, [direction, turning]])
    even = np.concatenate([right + left, [1.0, cosine, abs(direction), forward, distance]])
    turn, velocity = parameters[: len(odd)] @ odd, parameters[len(odd) :] @ even
    return np.tanh(np.array([velocity, turn]))


def episode(env: gymnasium.Env, parameters: np.ndarray, seed: int) -> tuple[float, bool, np.ndarray]:
    """Return the sum of rewards, success, and the path of one episode."""
    seen, _ = env.reset(seed=seed)
    robot = env.unwrapped.simulation.object("/Pioneer")
    total, path = 0.0, [robot.position[:2]]
    while True:
        seen, reward, terminated, truncated, info = env.step(action(parameters, seen).astype(np.float32))
        total += reward
        path.append(robot.position[:2])
        if terminated or truncated:
            return total, info["success"], np.array(path)


_ENVIRONMENT: list[gymnasium.Env] = []  # of this process


def evaluate(job: tuple[np.ndarray, list[int]]) -> tuple[float, float]:
    """Return mean reward and rate of success over seeds."""
    if not _ENVIRONMENT:
        _ENVIRONMENT.append(gymnasium.make("bubblesim/PioneerGoal-v0"))
    parameters, seeds = job
    results = [episode(_ENVIRONMENT[0], parameters, seed)[:2] for seed in seeds]
    return tuple(np.mean(results, axis=0))


def train(pool, iterations: int) -> tuple[np.ndarray, list[tuple[float, float, float]]]:
    """Return the parameters, and the curve: seconds, reward and success of the policy on seeds of the training."""
    random = np.random.default_rng(0)
    parameters, curve, begin, seed = np.zeros(PARAMETERS), [], time.monotonic(), 0
    average = parameters  # of the last iterations: less noisy than the last one
    for iteration in range(iterations):
        step = STEP * (1.0 - iteration / iterations)
        directions = random.standard_normal((DIRECTIONS, PARAMETERS))
        seeds = list(range(seed, seed + EPISODES))  # the same for all: less noise in their differences
        seed += EPISODES
        jobs = [(parameters + sign * NOISE * direction, seeds) for direction in directions for sign in (1, -1)]
        results = np.array(pool.map(evaluate, jobs, chunksize=1)).reshape(DIRECTIONS, 2, 2)
        rewards = results[:, :, 0]
        best = np.argsort(-rewards.max(axis=1))[:BEST]
        difference = rewards[best, 0] - rewards[best, 1]
        parameters = parameters + step / (BEST * rewards[best].std() + 1e-9) * difference @ directions[best]
        average = 0.9 * average + 0.1 * parameters
        curve.append((time.monotonic() - begin, results[:, :, 0].mean(), results[:, :, 1].mean()))
        print(f"{curve[-1][0]:5.0f} s  reward {curve[-1][1]:6.2f}  success {curve[-1][2]:.2f}", flush=True)
    return average, curve


def draw_curve(curve: list[tuple[float, float, float]], file: Path) -> None:
    """Plot reward and success of the perturbed policies over time."""
    seconds, rewards, successes = np.array(curve).T
    figure, axes = plt.subplots(2, 1, sharex=True, figsize=(6, 5), layout="constrained")
    axes[0].plot(seconds, rewards)
    axes[0].set_ylabel("mean reward")
    axes[1].plot(seconds, successes)
    axes[1].set(xlabel="time [s]", ylabel="success", ylim=(0, 1))
    figure.savefig(file, dpi=110)


def draw_paths(parameters: np.ndarray, file: Path, count: int = 6) -> None:
    """Draw the paths of some held-out episodes over the images of the camera."""
    env = gymnasium.make("bubblesim/PioneerGoal-v0", render_mode="rgb_array")
    figure, all_axes = plt.subplots(2, count // 2, figsize=(9, 6), layout="constrained")
    half = 14.0 * np.tan(0.4)  # m, that the camera sees from the middle
    for seed, axes in enumerate(all_axes.flat, HELD_OUT):
        _, success, path = episode(env, parameters, seed)
        env.reset(seed=seed)  # the image of the start
        # The camera looks down: the top of the image is +x, its left +y.
        axes.imshow(env.render(), extent=(half, -half, -half, half))
        axes.plot(path[:, 1], path[:, 0], color="#e4572e" if success else "black")
        axes.set(xticks=[], yticks=[], title="reached" if success else "not reached")
    figure.savefig(file, dpi=110)


def main() -> None:
    """Train, evaluate and draw."""
    parser = argparse.ArgumentParser()
    parser.add_argument("--iterations", type=int, default=40)
    parser.add_argument("--processes", type=int, default=2)
    parser.add_argument("--episodes", type=int, default=200, help="of the evaluation")
    parser.add_argument("--output", type=Path, default=Path())
    options = parser.parse_args()
    options.output.mkdir(parents=True, exist_ok=True)
    with multiprocessing.get_context("fork").Pool(options.processes) as pool:
        parameters, curve = train(pool, options.iterations)
        seeds = range(HELD_OUT, HELD_OUT + options.episodes)
        results = pool.map(evaluate, [(parameters, [seed]) for seed in seeds])
        pool.close()
        pool.join()
    np.save(options.output / "policy.npy", parameters)
    draw_curve(curve, options.output / "curve.png")
    draw_paths(parameters, options.output / "paths.png")
    used = os.times()
    print(f"CPU time {used.user + used.children_user:.0f} s")
    print(f"held-out seeds: success {np.mean([success for _, success in results]):.3f} of {len(results)} episodes")


if __name__ == "__main__":
    main()
