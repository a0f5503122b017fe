# SPDX-License-Identifier: BSD-3-Clause
"""Motion without friction over many steps: what it keeps, and how fast it converges."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any

import numpy as np

from .experiment import Experiment, Tolerance, product_of
from .mechanics import angular_momentum, kinetic_energy
from .rotation import pendulum, pendulum_theory
from .scene import GRAVITY, Body, Joint, Model, Scene, box_inertia, turned

KICK = 0.2  # s, in which forces start the motion


def chain() -> Model:
    """Return three bars in space, whose two hinges have axes at right angles."""
    bar = box_inertia(1.0, (0.5, 0.15, 0.1))
    bodies = tuple(Body(name, 1.0, bar, position=(0.5 * i, 0, 0)) for i, name in enumerate(("first", "middle", "last")))
    joints = (
        Joint("first_hinge", "revolute", "first", "middle", (0, 1, 0), (0.25, 0, 0)),
        Joint("last_hinge", "revolute", "middle", "last", (0, 0, 1), (0.75, 0, 0)),
    )
    return Model("robot", bodies, joints, (0, 0, 5))


def legs() -> Model:
    """Return a trunk in space with four legs that swing freely, each in one plane."""
    bodies = [Body("first", 5.0, box_inertia(5.0, (0.4, 0.3, 0.1)))]
    joints = []
    hips = [(x, y) for y in (0.15, -0.15) for x in (0.2, -0.2)]
    for i, (x, y) in enumerate(hips):
        name = "last" if i == len(hips) - 1 else f"leg{i}"
        bodies.append(Body(name, 0.5, box_inertia(0.5, (0.05, 0.05, 0.3)), position=(x, y, -0.15)))
        joints.append(Joint(f"hip{i}", "revolute", "first", name, (i % 2, 1 - i % 2, 0), (x, y, 0)))
    return Model("robot", tuple(bodies), tuple(joints), (0, 0, 5))


ROBOTS = {"chain": chain, "legs": legs}


def kept(**case: Any) -> float:
    """Nothing acts from outside and no joint has friction: energy and momenta do not change (Newton, Euler)."""
    return 0.0


def greatest_change(world: Any, interval: float, value: Callable[[], Any]) -> tuple[Any, float]:
    """Run a world for 100 intervals, s; return a value at the start and how far from it it was at most after one."""
    start = value()
    worst = 0.0
    for _ in range(100):
        world.run(interval)
        worst = max(worst, float(np.linalg.norm(value() - start)))
    return start, worst


def in_space(engine: Any, robot: str, quantity: str, step: float, steps: int) -> float:
    """Kick a robot so that it tumbles; return the greatest relative change in these steps, looked at 100 times."""
    model = ROBOTS[robot]()
    world = engine(Scene((model,), step=step, gravity=(0, 0, 0), ground=False))
    world.run(KICK, {"first": (0.0, 3.0, 1.0), "last": (0.0, -3.0, 2.0)})

    def value() -> np.ndarray:
        if quantity == "energy":
            return np.array([sum(kinetic_energy(world, body) for body in model.bodies)])
        if quantity == "momentum":
            return np.sum([body.mass * world.velocity(body.name) for body in model.bodies], axis=0)
        spins = [angular_momentum(world, body) for body in model.bodies]
        orbits = [body.mass * np.cross(world.position(body.name), world.velocity(body.name)) for body in model.bodies]
        return np.sum(spins, axis=0) + np.sum(orbits, axis=0)

    start, worst = greatest_change(world, steps // 100 * step, value)
    return worst / float(np.linalg.norm(start))


def double_pendulum(engine: Any, step: float, steps: int) -> float:
    """Let a double pendulum swing from 60 degrees; return the greatest change of its energy, in m g l."""
    mass, length = 1.0, 1.0
    bar = box_inertia(mass, (0.05, 0.05, length))
    upper = Body("upper", mass, bar, position=(0, 0, -length / 2))
    lower = Body("lower", mass, bar, position=(0, 0, -1.5 * length))
    joints = (
        Joint("shoulder", "revolute", "world", "upper", (0, 1, 0), (0, 0, 0)),
        Joint("elbow", "revolute", "upper", "lower", (0, 1, 0), (0, 0, -length)),
    )
    model = Model("pendulum", (upper, lower), joints, (0, 0, 3), turned((0, 1, 0), math.radians(60)))
    world = engine(Scene((model,), step=step, ground=False))

    def energy() -> float:
        return sum(kinetic_energy(world, b) + b.mass * GRAVITY * world.position(b.name)[2] for b in model.bodies)

    _, worst = greatest_change(world, steps // 100 * step, energy)
    return worst / (mass * GRAVITY * length)


def order_theory(degrees: float) -> float:
    """The error of a symplectic method of first order falls with the square of the step in a period.

    It is conjugate to one of second order (Hairer, Lubich, Wanner, Geometric Numerical Integration, 2006, VI.8).
    """
    return 2.0


def order(engine: Any, degrees: float) -> float:
    """Return the logarithm to base 2 of what half the step does to the error of a pendulum's period, at 5 ms."""
    coarse, fine = (abs(pendulum(engine, degrees, step) - pendulum_theory(degrees, step)) for step in (0.005, 0.0025))
    return math.log2(coarse / fine)


def experiments(steps: int, *, long: bool) -> list[Experiment]:
    """Return what motion keeps in a number of steps."""
    name, words = ("_long", "10^6 steps") if long else ("", "10^5 steps")
    return [
        Experiment(
            f"space_energy{name}",
            f"Robot that tumbles in space, relative change of energy in {words}",
            "",
            kept,
            in_space,
            Tolerance("a reversible method of second order: some (w dt)^2, without a drift", absolute=0.001),
            product_of(robot=tuple(ROBOTS), quantity=("energy",), step=(0.001, 0.005), steps=(steps,)),
            ode=False,
            long=long,
        ),
        Experiment(
            f"space_momentum{name}",
            f"Robot that tumbles in space, relative change of momenta in {words}",
            "",
            kept,
            in_space,
            Tolerance("rounding of doubles", absolute=1e-9),
            product_of(robot=tuple(ROBOTS), quantity=("momentum", "angular momentum"), step=(0.005,), steps=(steps,)),
            ode=False,
            long=long,
        ),
        Experiment(
            f"double_pendulum{name}",
            f"Double pendulum, change of energy in m g l in {words}",
            "",
            kept,
            double_pendulum,
            Tolerance("a symplectic method of first order: some w dt, without a drift", absolute=0.01),
            product_of(step=(0.001, 0.005), steps=(steps,)),
            ode=not long,
            long=long,
        ),
    ]


EXPERIMENTS = [
    Experiment(
        "order",
        "Order of convergence of a pendulum's period",
        "",
        order_theory,
        order,
        Tolerance("terms of higher order", absolute=0.05),
        product_of(degrees=(30.0, 120.0, 170.0)),
        ode=False,
    ),
    *experiments(100_000, long=False),
    *experiments(1_000_000, long=True),
]
