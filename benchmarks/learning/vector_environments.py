# SPDX-License-Identifier: BSD-3-Clause
"""Compares the vector environment of a task with Gymnasium's AsyncVectorEnv of its single environment.

python benchmarks/learning/vector_environments.py [bubblesim/CartPole-v0 ...]
"""

import os
import statistics
import sys
import time
from pathlib import Path

import gymnasium

import bubblesim.gym_tasks  # noqa: F401  # registers the tasks

WORLDS = 16
STEPS = 10  # of all worlds in a round
ROUNDS = 15


def cpu_seconds(worlds: gymnasium.vector.VectorEnv) -> float:
    """Return the CPU time of this process and of those of the environment so far."""
    total = time.process_time()
    for process in getattr(worlds, "processes", []):
        fields = Path(f"/proc/{process.pid}/stat").read_text().rpartition(")")[2].split()
        total += (int(fields[11]) + int(fields[12])) / os.sysconf("SC_CLK_TCK")
    return total


def seconds(worlds: gymnasium.vector.VectorEnv) -> tuple[float, float]:
    """Return the time of a round of random actions, and its CPU time."""
    actions = [worlds.action_space.sample() for _ in range(STEPS)]
    start, cpu_start = time.perf_counter(), cpu_seconds(worlds)
    for action in actions:
        worlds.step(action)
    return time.perf_counter() - start, cpu_seconds(worlds) - cpu_start


def compare(name: str) -> None:
    """Print the medians of rounds that alternate, and the sums of their CPU times, which have a resolution of 10 ms."""
    asynchronous = gymnasium.make_vec(name, num_envs=WORLDS, vectorization_mode="async")
    batched = gymnasium.make_vec(name, num_envs=WORLDS, vectorization_mode="vector_entry_point")
    for worlds in (asynchronous, batched):
        worlds.reset(seed=0)
        seconds(worlds)
    rounds = [(seconds(asynchronous), seconds(batched)) for _ in range(ROUNDS)]
    ratio = statistics.median(old[0] / new[0] for old, new in rounds)
    old_cpu, new_cpu = sum(old[1] for old, _ in rounds), sum(new[1] for _, new in rounds)
    each = new_cpu / (STEPS * WORLDS * ROUNDS) * 1e6
    print(
        f"{name}: {each:.0f} us of CPU time for each step of a world; AsyncVectorEnv takes {ratio:.1f} x the time and"
    )
    print(f"  {old_cpu / new_cpu:.1f} x the CPU time")
    asynchronous.close()
    batched.close()


if __name__ == "__main__":
    for task in sys.argv[1:] or [name for name in gymnasium.registry if name.startswith("bubblesim/")]:
        compare(task)
