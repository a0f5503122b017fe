# SPDX-License-Identifier: BSD-3-Clause
"""Train bubblesim/PioneerGoal-v0 by PPO of stable-baselines3 (pip install stable-baselines3).

python docs/learning/ppo_pioneer.py [--steps 300000] [--output FOLDER]
"""

import argparse
from pathlib import Path

import gymnasium
from stable_baselines3 import PPO
from stable_baselines3.common.env_util import make_vec_env
from stable_baselines3.common.evaluation import evaluate_policy

import bubblesim.gym_tasks  # noqa: F401  # registers the environment


def main() -> None:
    """Train, save and evaluate."""
    parser = argparse.ArgumentParser()
    parser.add_argument("--steps", type=int, default=300_000)
    parser.add_argument("--worlds", type=int, default=8)
    parser.add_argument("--output", type=Path, default=Path())
    options = parser.parse_args()
    worlds = make_vec_env("bubblesim/PioneerGoal-v0", n_envs=options.worlds, seed=0)
    model = PPO("MlpPolicy", worlds, n_steps=128, batch_size=256, seed=0, device="cpu", verbose=1)
    model.learn(options.steps)
    model.save(options.output / "ppo_pioneer.zip")
    env = gymnasium.make("bubblesim/PioneerGoal-v0")
    mean, deviation = evaluate_policy(model, env, n_eval_episodes=20, warn=False)
    print(f"reward of 20 episodes: {mean:.2f} ± {deviation:.2f}")


if __name__ == "__main__":
    main()
