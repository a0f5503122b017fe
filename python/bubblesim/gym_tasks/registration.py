# SPDX-License-Identifier: BSD-3-Clause
"""The names under which Gymnasium makes the tasks."""

import gymnasium

# Name, module and class of the task, most steps of an episode.
_TASKS = {
    "bubblesim/CartPole-v0": ("cartpole:CartPole", 500),
    "bubblesim/PioneerGoal-v0": ("pioneer_goal:PioneerGoal", 150),
    "bubblesim/TricycleAvoid-v0": ("tricycle_avoid:TricycleAvoid", 600),
    "bubblesim/BubbleRobMaze-v0": ("bubblerob_maze:BubbleRobMaze", 800),
    "bubblesim/LineFollow-v0": ("line_follow:LineFollow", 400),
}


def register_tasks() -> None:
    """Register all tasks, once."""
    for name, (task, most_steps) in _TASKS.items():
        if name not in gymnasium.registry:
            gymnasium.register(
                name,
                entry_point="bubblesim.gym_tasks.environment:TaskEnv",
                vector_entry_point="bubblesim.gym_tasks.vector_environment:TaskVectorEnv",
                max_episode_steps=most_steps,
                kwargs={"task": f"bubblesim.gym_tasks.{task}"},
            )
