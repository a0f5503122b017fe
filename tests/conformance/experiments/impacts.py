# SPDX-License-Identifier: BSD-3-Clause
"""Impacts beside the centre of mass, and those that travel through bodies that touch."""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from .experiment import Experiment, Tolerance, product_of
from .scene import Body, Joint, Model, Scene, Shape, sphere, turned

ROD = Body(
    "rod",
    1.0,
    (1e-3, 1 / 12, 1 / 12),
    tuple(Shape("sphere", (0.02,), (x, 0, 0)) for x in (-0.5, 0.5)),
    mu=0.0,
    bounce=0.5,
)


def rod_theory(degrees: float, step: float) -> float:
    """w = J r / I with J = (1 + e) v / (1 / m + r^2 / I), r = l / 2 cos(a) (Newton's restitution at the end that hits).

    A rod of 1 kg and 1 m falls without spin at 1 m/s on its end, at an angle to the smooth floor; e = 0.5.
    """
    lever, inertia = 0.5 * math.cos(math.radians(degrees)), ROD.inertia[1]
    return 1.5 / (1 + lever**2 / inertia) * lever / inertia


def rod(engine: Any, degrees: float, step: float) -> float:
    """Return the spin after the impact; without gravity."""
    angle = math.radians(degrees)
    model = Model("rod", (ROD,), (), (0, 0, 0.5 * math.sin(angle) + 0.12), turned((0, 1, 0), angle))
    world = engine(Scene((model,), step=step, gravity=(0, 0, 0)))
    world.set_velocity("rod", (0, 0, -1))
    world.run(0.2)
    return float(np.linalg.norm(world.spin("rod")))


BALLS, RADIUS, WIRE = 5, 0.05, 0.5


def cradle_theory(hung: bool, hitting: int, step: float) -> float:
    """As many equal balls fly off as hit a row that touches, at the same speed; the others stand (Newton's cradle)."""
    return 1.0


def cradle(engine: Any, hung: bool, hitting: int, step: float) -> float:
    """Hit a row of balls at 1 m/s; return the speed of the slowest that should fly, less the fastest of the others."""
    models = []
    for i in range(BALLS):
        ball = sphere(
            f"ball{i}", RADIUS, (2 * RADIUS * i - (0.05 if i < hitting and not hung else 0), 0, 1), mu=0.0, bounce=1.0
        )
        if hung:
            wire = Joint(f"wire{i}", "revolute", "world", f"ball{i}", (0, -1, 0), (0, 0, WIRE))
            ball = Model(ball.name, ball.bodies, (wire,), ball.position)
        models.append(ball)
    world = engine(Scene(tuple(models), step=step, gravity=(0, 0, 0), ground=False))
    for i in range(hitting):
        if hung:
            world.set_motion(models[i], (1, 0, 0), {f"wire{i}": 1 / WIRE})
        else:
            world.set_velocity(f"ball{i}", (1, 0, 0))
    world.run(0.1)
    speeds = [float(np.linalg.norm(world.velocity(f"ball{i}"))) for i in range(BALLS)]
    return min(speeds[BALLS - hitting :]) - max(speeds[: BALLS - hitting])


EXPERIMENTS = [
    Experiment(
        "rod_impact",
        "Rod that falls on its end, spin after the impact",
        "rad/s",
        rod_theory,
        rod,
        Tolerance("the angle of a step before the impact", relative=0.002),
        product_of(degrees=(10.0, 30.0, 60.0), step=(0.001, 0.005)),
        peers=("PyBullet",),
    ),
    Experiment(
        "cradle",
        "Newton's cradle of five balls that touch, speed of those that fly less that of the others",
        "m/s",
        cradle_theory,
        cradle,
        Tolerance("the path of a step before the impact, 1 mm, in which the balls overlap", absolute=0.002),
        product_of(hung=(False, True), hitting=(1, 2), step=(0.0005, 0.001)),
        peers=("PyBullet",),
        ode=False,
    ),
]
