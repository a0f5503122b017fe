# SPDX-License-Identifier: BSD-3-Clause
"""CartPole: balance a pole on a cart, as Gymnasium's CartPole-v1 (Barto, Sutton, Anderson 1983)."""

from __future__ import annotations

from typing import ClassVar

import numpy as np
from gymnasium import spaces

import bubblesim
from bubblesim.gym_tasks.task import SCENES, Array, Task

FORCE = 10.0  # N
LIMITS = (2.4, 12 * 2 * np.pi / 360)  # m of the cart, rad of the pole


class CartPole(Task):
    """Actions: push to the left (0) or to the right (1) with 10 N for 0.02 s.

    Observation: position (m) and velocity (m/s) of the cart, angle (rad) and angular velocity (rad/s) of the pole.
    Reward: 1 for each step. Ends when the cart is 2.4 m or the pole 12 degrees off.
    """

    scene: ClassVar[str] = str(SCENES / "cartpole.sdf")
    actions: ClassVar = ["/Slider.target_effort"]
    observations: ClassVar = [
        "/Slider.joint_position",
        "/Slider.joint_velocity",
        "/Hinge.joint_position",
        "/Hinge.joint_velocity",
    ]
    action_space = spaces.Discrete(2)
    observation_space = spaces.Box(-np.inf, np.inf, (4,), np.float32)

    def place(self, world: int, simulation: bubblesim.Simulation, random: np.random.Generator) -> None:
        """Draw the four numbers of the state from -0.05 to 0.05."""
        place_state(simulation, random.uniform(-0.05, 0.05, 4))

    def commands(self, actions: Array) -> Array:
        """Return the force."""
        return np.where(np.asarray(actions) == 1, FORCE, -FORCE)[:, None]

    def observe(self, rows: Array) -> Array:
        """Return the state."""
        return rows

    def judge(self, rows: Array) -> tuple[Array, Array, dict[str, Array]]:
        """Return 1 for each step."""
        fallen = (np.abs(rows[:, 0]) > LIMITS[0]) | (np.abs(rows[:, 2]) > LIMITS[1])
        return np.ones(len(rows)), fallen, {}


def place_state(simulation: bubblesim.Simulation, state: Array) -> None:
    """Set position and velocity of the cart, angle and angular velocity of the pole."""
    position, speed, angle, turning = map(float, state)
    world = simulation.world
    slider, hinge, cart, pole = (simulation.object(f"/{name}") for name in ("Slider", "Hinge", "cart", "pole"))
    world.set_joint_position(slider.handle, position)
    world.set_joint_position(hinge.handle, angle)
    cart.linear_velocity = [speed, 0.0, 0.0]
    pole.angular_velocity = [0.0, turning, 0.0]
    pole.linear_velocity = [speed, 0.0, 0.0]
