# SPDX-License-Identifier: BSD-3-Clause
"""Quantities of moving bodies."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from typing import Any

import numpy as np

from .scene import Body


def rotation(q: Sequence[float]) -> np.ndarray:
    """Return the matrix of a quaternion x, y, z, w."""
    x, y, z, w = q
    return np.array(
        [
            [1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
            [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
            [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)],
        ]
    )


def spin_in_body(world: Any, body: Body) -> np.ndarray:
    """Return the angular velocity in the body's axes."""
    return rotation(world.orientation(body.name)).T @ world.spin(body.name)


def angular_momentum(world: Any, body: Body) -> np.ndarray:
    """Return I w about the centre of mass, world axes."""
    turn = rotation(world.orientation(body.name))
    return turn @ (np.array(body.inertia) * (turn.T @ world.spin(body.name)))


def kinetic_energy(world: Any, body: Body) -> float:
    """Return the energy of translation and rotation, J."""
    spin, velocity = spin_in_body(world, body), world.velocity(body.name)
    return float(0.5 * body.mass * velocity @ velocity + 0.5 * (np.array(body.inertia) * spin) @ spin)


def complete_elliptic_integral(modulus: float) -> float:
    """Return K(k) by the arithmetic-geometric mean: pi / (2 M(1, sqrt(1 - k^2)))."""
    a, b = 1.0, math.sqrt(1 - modulus**2)
    while abs(a - b) > 1e-15 * a:
        a, b = (a + b) / 2, math.sqrt(a * b)
    return math.pi / (2 * a)


def crossings(times: Sequence[float], values: Sequence[float]) -> list[float]:
    """Return when the values change their sign, by linear interpolation."""
    found = []
    for i in range(1, len(values)):
        before, after = values[i - 1], values[i]
        if before * after < 0:
            found.append(times[i - 1] + (times[i] - times[i - 1]) * before / (before - after))
    return found


def runge_kutta(
    rates: Callable[[np.ndarray], np.ndarray], state: np.ndarray, step: float, steps: int
) -> list[np.ndarray]:
    """Return the states of Runge and Kutta's method of fourth order."""
    states = [state]
    for _ in range(steps):
        a = rates(state)
        b = rates(state + step / 2 * a)
        c = rates(state + step / 2 * b)
        d = rates(state + step * c)
        state = state + step / 6 * (a + 2 * b + 2 * c + d)
        states.append(state)
    return states


def recorded(world: Any, until: float, step: float, value: Callable[[], float]) -> tuple[list[float], list[float]]:
    """Run a world until a time, s; return the times and the values after each step."""
    times, values = [], []
    while world.time < until:
        world.run(step)
        times.append(world.time)
        values.append(float(value()))
    return times, values


def rate_of(world: Any, seconds: float, value: Callable[[], Any]) -> Any:
    """Run a world for some seconds; return the mean rate at which a value has changed."""
    before = value()
    world.run(seconds)
    return (value() - before) / seconds
