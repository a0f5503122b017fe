# SPDX-License-Identifier: BSD-3-Clause
"""Mechanisms: closed loops, a caster, and a pole that is balanced."""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from .experiment import Experiment, Tolerance, lowest, product_of
from .scene import GRAVITY, Body, Joint, Model, Scene, Shape, sphere_inertia

RATE = 15.0  # rad/s, of the cranks
UP = (0.0, 0.0, 1.0)


def exact(**case: Any) -> float:
    """Where the crank is determines where all parts are: plane trigonometry, see piston() and rocker()."""
    return 0.0


def bar(name: str, start: tuple[float, float], end: tuple[float, float], mass: float) -> Body:
    """Return a thin bar between two points of the plane; only its inertia about the normal matters."""
    middle = ((start[0] + end[0]) / 2, (start[1] + end[1]) / 2, 0.0)
    return Body(name, mass, (mass * math.dist(start, end) ** 2 / 12,) * 3, position=middle)


def hinge(name: str, parent: str, child: str, place: tuple[float, float], motor: str = "") -> Joint:
    """Return a hinge at a point of the plane."""
    return Joint(name, "revolute", parent, child, UP, (*place, 0.0), motor, 1e4)


CRANK, ROD = 0.1, 0.3  # m


def piston(angle: float) -> float:
    """Return how far the piston is from where it is at the angle 0: x = r cos a + sqrt(l^2 - r^2 sin^2 a)."""
    return CRANK * math.cos(angle) + math.sqrt(ROD**2 - (CRANK * math.sin(angle)) ** 2) - CRANK - ROD


def slider_crank() -> Model:
    """Return a crank, a connecting rod and a piston; the wrist closes the loop."""
    top = CRANK + ROD
    bodies = (
        bar("crank", (0, 0), (CRANK, 0), 1.0),
        bar("rod", (CRANK, 0), (top, 0), 0.5),
        Body("piston", 1.0, (1e-3,) * 3, position=(top, 0, 0)),
    )
    joints = (
        hinge("shaft", "world", "crank", (0, 0), "velocity"),
        hinge("pin", "crank", "rod", (CRANK, 0)),
        Joint("driven", "prismatic", "world", "piston", (1, 0, 0), (top, 0, 0)),
        hinge("wrist", "rod", "piston", (top, 0)),
    )
    return Model("mechanism", bodies, joints, (0, 0, 1))


SIDES = (0.1, 0.35, 0.3, 0.4)  # m: crank, coupler, rocker, ground


def rocker(angle: float) -> float:
    """Return the rocker's angle to the ground: the law of cosines in the triangle of coupler, rocker and diagonal."""
    a, b, c, d = SIDES
    x, y = a * math.cos(angle) - d, a * math.sin(angle)
    diagonal = math.hypot(x, y)
    return math.atan2(y, x) - math.acos((c**2 + diagonal**2 - b**2) / (2 * c * diagonal))


def four_bar() -> Model:
    """Return a crank, a coupler and a rocker; the last hinge closes the loop."""
    a, _, c, d = SIDES
    end = (d + c * math.cos(rocker(0.0)), c * math.sin(rocker(0.0)))
    bodies = (bar("crank", (0, 0), (a, 0), 1.0), bar("coupler", (a, 0), end, 0.5), bar("rocker", (d, 0), end, 0.5))
    joints = (
        hinge("shaft", "world", "crank", (0, 0), "velocity"),
        hinge("pin", "crank", "coupler", (a, 0)),
        hinge("driven", "world", "rocker", (d, 0)),
        hinge("wrist", "coupler", "rocker", end),
    )
    return Model("mechanism", bodies, joints, (0, 0, 1))


def closed_loop(engine: Any, mechanism: str, step: float) -> float:
    """Return how far the driven part is from its place at most, m, from 0.5 to 2 s after the start."""
    lever = {"slider-crank": 1.0, "four-bar": SIDES[2]}[mechanism]  # of the driven joint, which is in m or rad
    model, place = {"slider-crank": (slider_crank(), piston), "four-bar": (four_bar(), rocker)}[mechanism]
    world = engine(Scene((model,), step=step, ground=False))
    world.set_target("shaft", RATE)
    world.run(0.5)
    worst = 0.0
    for _ in range(round(1.5 / step)):
        world.run(step)
        wanted = place(world.joint_position("shaft")) - place(0.0)
        worst = max(worst, lever * abs(math.remainder(world.joint_position("driven") - wanted, 2 * math.pi)))
    return worst


TRAIL, WHEEL, START = 0.05, 0.05, math.radians(170)  # m, m, angle of the swivel to the way


def caster_theory(step: float) -> float:
    """tan(a / 2) = tan(a0 / 2) exp(-x / t): a wheel that does not slip aside at the trail t behind its swivel.

    The tractrix of Leibniz and Huygens; here the way x until the wheel is beside the swivel, from 170 degrees.
    """
    return TRAIL * math.log(math.tan(START / 2))


def caster(engine: Any, step: float) -> float:
    """Push a caster backwards until it has turned by 80 degrees; return the way."""
    place = (-TRAIL * math.cos(START), -TRAIL * math.sin(START), 0.0)
    across = (-math.sin(START), math.cos(START), 0.0)
    bodies = (
        Body("rail", 0.1, (1e-3,) * 3),
        Body("post", 3.0, (1e-2,) * 3),
        Body("fork", 0.05, (1e-5,) * 3),
        Body("wheel", 0.1, sphere_inertia(0.1, WHEEL), (Shape("sphere", (WHEEL,)),), place),
    )
    joints = (
        Joint("way", "prismatic", "world", "rail", (1, 0, 0), motor="velocity", effort=1e3),
        Joint("height", "prismatic", "rail", "post", UP),
        Joint("swivel", "revolute", "post", "fork", UP),
        Joint("axle", "revolute", "fork", "wheel", across, place),
    )
    world = engine(Scene((Model("caster", bodies, joints, (0, 0, WHEEL)),), step=step))
    world.run(0.1)
    begin = world.joint_position("way")
    world.set_target("way", 0.1)
    ways, angles = [], []
    for _ in range(300):
        world.run(0.01)
        ways.append(world.joint_position("way") - begin)
        angles.append(START + world.joint_position("swivel"))
    return float(np.interp(-math.pi / 2, -np.array(angles), ways))


CART, POLE, HALF = 1.0, 0.1, 0.5  # kg, kg, m
GAINS = np.array([-3.0, -42.0, -5.0, -11.0])  # N per m, rad, m/s, rad/s


def exponential(matrix: np.ndarray) -> np.ndarray:
    """Return e^A by squaring: (e^(A / 2^20))^(2^20)."""
    small = matrix / 2**20
    power = np.eye(len(matrix)) + small + small @ small / 2
    for _ in range(20):
        power = power @ power
    return power


def balances(period: float) -> bool:
    """Return whether the sampled loop is stable: all eigenvalues of A(T) - B(T) K within the unit circle."""
    inertia = POLE * HALF**2 / 3 + POLE * HALF**2
    masses = np.linalg.inv(np.array([[CART + POLE, POLE * HALF], [POLE * HALF, inertia]]))
    rates = np.zeros((5, 5))  # of the state and of a force that is held
    rates[0, 2] = rates[1, 3] = 1
    rates[2:4, 1] = masses @ [0, POLE * GRAVITY * HALF]
    rates[2:4, 4] = masses @ [1, 0]
    sampled = exponential(rates * period)
    return bool(np.abs(np.linalg.eigvals(sampled[:4, :4] - np.outer(sampled[:4, 4], GAINS))).max() < 1)


def period_theory() -> float:
    """The longest period of a sampled control with which a pole stays up (Franklin, Powell, Workman, chapter 4)."""
    return lowest(lambda period: not balances(period), 0.05, 0.4, 1e-5)


def longest_period(engine: Any) -> float:
    """Return the longest period, to a step of 1 ms, with which a push dies away."""
    inertia = POLE * HALF**2 / 3
    bodies = (Body("cart", CART, (1e-2,) * 3), Body("pole", POLE, (inertia, inertia, 1e-6), position=(0, 0, HALF)))
    joints = (
        Joint("rail", "prismatic", "world", "cart", (1, 0, 0), motor="effort", effort=1e3),
        Joint("hinge", "revolute", "cart", "pole", (0, 1, 0)),
    )

    def falls(period: float) -> bool:
        world = engine(Scene((Model("pole", bodies, joints, (0, 0, 1)),), step=0.001, ground=False))
        push = 0.01
        for _ in range(round(12 / period)):
            state = [
                value(joint) for value in (world.joint_position, world.joint_velocity) for joint in ("rail", "hinge")
            ]
            world.set_target("rail", push - float(GAINS @ state))
            world.run(period)
            push = 0.0
            if abs(state[1]) > 0.5:
                return True
        return abs(world.joint_position("hinge")) > 1e-4

    return 0.001 * lowest(lambda steps: falls(0.001 * round(steps)), 50, 400, 0.5)


EXPERIMENTS = [
    Experiment(
        "closed_loop",
        "Closed loops at 15 rad/s, error of the driven part",
        "m",
        exact,
        closed_loop,
        Tolerance("a crank of 0.1 m leaves its circle by r (w dt)^2 / 2 = 0.3 mm in a step of 5 ms", absolute=0.0004),
        product_of(mechanism=("slider-crank", "four-bar"), step=(0.001, 0.005)),
        peers=(),
    ),
    Experiment(
        "caster",
        "Caster that is pushed backwards, way until it has turned by 80 degrees",
        "m",
        caster_theory,
        caster,
        Tolerance("semi-implicit Euler is late by half a step of 0.5 mm; the fork has inertia", relative=0.01),
        product_of(step=(0.001, 0.005)),
    ),
    Experiment(
        "balance",
        "Pole on a cart, longest period of its control",
        "s",
        period_theory,
        longest_period,
        Tolerance("a push must die away within 12 s; a step of 1 ms", relative=0.015),
    ),
]
