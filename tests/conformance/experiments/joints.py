# SPDX-License-Identifier: BSD-3-Clause
"""Joint stops, motors that stall, and chains with great mass ratios."""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from .experiment import Experiment, Tolerance, product_of
from .mechanics import recorded, rotation
from .scene import GRAVITY, Body, Joint, Model, Scene, box_inertia, turned


def inelastic(**case: Any) -> float:
    """A stop without restitution takes all of the speed (Newton's law of impact with e = 0)."""
    return 0.0


def above_its_stop(engine: Any, kind: str, step: float) -> Any:
    """Return a world in which an arm or a slider falls against the stop of its joint."""
    place = (0.5, 0.0, 0.0) if kind == "revolute" else (0.0, 0.0, 0.0)
    axis = (0.0, 1.0, 0.0) if kind == "revolute" else (0.0, 0.0, -1.0)
    arm = Body("arm", 2.0, box_inertia(2.0, (1.0, 0.1, 0.1)), position=place)
    joint = Joint("joint", kind, "world", "arm", axis, (0.0, 0.0, 0.0), lower=-2.0, upper=1.0)
    return engine(Scene((Model("model", (arm,), (joint,), (0, 0, 3)),), step=step, ground=False))


def stop(engine: Any, kind: str, step: float) -> float:
    """Return the greatest speed back from the stop over that of the impact."""
    world = above_its_stop(engine, kind, step)
    _, speeds = recorded(world, 1.5, step, lambda: world.joint_velocity("joint"))
    return -min(0.0, *speeds) / max(speeds)


def reached_theory(kind: str, step: float) -> float:
    """The stop holds the joint at its limit."""
    return 1.0


def reached(engine: Any, kind: str, step: float) -> float:
    """Return the position 1.5 s after the impact."""
    world = above_its_stop(engine, kind, step)
    world.run(2.0)
    return float(world.joint_position("joint"))


ARM, REACH = 2.0, 0.5  # kg, m


def stall_theory(share: float, step: float) -> float:
    """A motor lifts an arm until m g l sin(a) is its greatest effort (statics); here a share of m g l."""
    return math.degrees(math.asin(share))


def stall(engine: Any, share: float, step: float) -> float:
    """Lift a hanging arm slowly until its motor stalls; return the mean angle over a few swings after that."""
    arm = Body("arm", ARM, box_inertia(ARM, (0.05, 0.05, 2 * REACH)), position=(0, 0, -REACH))
    effort = share * ARM * GRAVITY * REACH
    joint = Joint("joint", "revolute", "world", "arm", (0, 1, 0), (0, 0, 0), "velocity", effort)
    world = engine(Scene((Model("model", (arm,), (joint,), (0, 0, 3)),), step=step, ground=False))
    world.set_target("joint", 0.05)
    world.run(80.0)
    _, angles = recorded(world, 100.0, 0.05, lambda: world.joint_position("joint"))
    return math.degrees(sum(angles) / len(angles))


LINKS = 10


def closed(**case: Any) -> float:
    """A joint has no gap."""
    return 0.0


def chain(engine: Any, ratio: float, step: float, link: float = 1.0, substeps: str = "") -> float:
    """Swing a chain of ten links of 1 kg and a heavy last one from 30 degrees; return the widest gap in 5 s."""
    bodies, joints = [], []
    height = 2.0 * link * LINKS
    physics = f"<bubblesim:substeps>{substeps}</bubblesim:substeps>" if substeps else ""
    for i in range(LINKS):
        mass = ratio if i == LINKS - 1 else 1.0
        size = (0.05, 0.05, link) if i < LINKS - 1 else (0.4, 0.4, link)
        bodies.append(Body(f"link{i}", mass, box_inertia(mass, size), position=(0, 0, -link * (i + 0.5))))
        parent = f"link{i - 1}" if i else "world"
        joints.append(Joint(f"joint{i}", "revolute", parent, f"link{i}", (0, 1, 0), (0, 0, -link * i)))
    model = Model("chain", tuple(bodies), tuple(joints), (0, 0, height), turned((0, 1, 0), math.radians(30)))
    world = engine(Scene((model,), step=step, ground=False, physics=physics))
    top, half = np.array([0, 0, height]), np.array([0, 0, link / 2])
    widest = 0.0
    for _ in range(500):
        world.run(0.01)
        above = top
        for body in bodies:
            turn, place = rotation(world.orientation(body.name)), world.position(body.name)
            widest = max(widest, float(np.linalg.norm(place + turn @ half - above)))
            above = place - turn @ half
        if not widest < 100:
            return math.inf
    return widest


EXPERIMENTS = [
    Experiment(
        "stop",
        "Joint stop, speed back over speed of impact",
        "",
        inelastic,
        stop,
        Tolerance("the correction of the overshoot of one step", absolute=0.02),
        product_of(kind=("revolute", "prismatic"), step=(0.001, 0.002, 0.005)),
    ),
    Experiment(
        "stop_position",
        "Joint stop, position under load",
        "rad, m",
        reached_theory,
        reached,
        Tolerance("compliance of the stop", absolute=0.002),
        product_of(kind=("revolute", "prismatic"), step=(0.001, 0.005)),
    ),
    Experiment(
        "stall",
        "Arm that a weak motor lifts, angle where it stalls",
        "deg",
        stall_theory,
        stall,
        Tolerance("it swings by the target over the rate of swinging: 0.05 / 3 rad", absolute=1.0),
        product_of(share=(0.25, 0.5, 0.8), step=(0.001, 0.005)),
    ),
    Experiment(
        "chain",
        "Chain of ten with a heavy end, widest gap of a joint",
        "m",
        closed,
        chain,
        Tolerance("a thousandth of a link", absolute=0.001),
        (
            {"ratio": 1000.0, "step": 0.005},
            {"ratio": 2000.0, "step": 0.005, "substeps": "auto"},
            {"ratio": 10000.0, "step": 0.001},
            {"ratio": 2000.0, "step": 0.005, "link": 0.2, "substeps": "auto"},
        ),
        peers=(),
    ),
]
