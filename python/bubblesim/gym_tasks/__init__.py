# SPDX-License-Identifier: BSD-3-Clause
"""Gymnasium environments. Importing this package registers them:

>>> import gymnasium, bubblesim.gym_tasks
>>> env = gymnasium.make("bubblesim/PioneerGoal-v0")
>>> envs = gymnasium.make_vec("bubblesim/PioneerGoal-v0", num_envs=64)
"""

from bubblesim.gym_tasks.registration import register_tasks

register_tasks()
