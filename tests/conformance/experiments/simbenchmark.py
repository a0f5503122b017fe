# SPDX-License-Identifier: BSD-3-Clause
"""Tests of SimBenchmark (Kang and Hwangbo, https://leggedrobotics.github.io/SimBenchmark), after its descriptions."""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from .experiment import Experiment, Tolerance, product_of
from .mechanics import kinetic_energy
from .scene import GRAVITY, Body, Joint, Model, Scene, Shape, box, box_inertia, sphere


def rolling_theory(body: str, heading: float) -> float:
    """A board of M = 10 kg on the ground (mu 0.4) carries n = 25 balls of 1 kg and is pushed by F = 150 N.

    The balls roll on it with 2/7 of its acceleration: a = (F - mu (M + n m) g) / (M + 2/7 n m).
    """
    board = (150 - 0.4 * 35 * GRAVITY) / (10 + 25 * 2 / 7)
    return board if body == "board" else board * 2 / 7


def rolling(engine: Any, body: str, heading: float) -> float:
    """Push the board at 1 ms; return the acceleration of the board or the mean of the balls."""
    board = box("board", (2.4, 2.4, 0.1), (0, 0, 0.05), mass=10.0, mu=0.4)
    balls = [sphere(f"ball{i}", 0.1, (0.4 * (i % 5 - 2), 0.4 * (i // 5 - 2), 0.2), mu=0.8) for i in range(25)]
    # The lower friction of two counts: between ball (0.8) and board it would be 0.4, of which the balls need 0.02.
    world = engine(Scene((board, *balls), step=0.001))
    world.run(0.1)
    turn = math.radians(heading)
    push = {"board": (150 * math.cos(turn), 150 * math.sin(turn), 0.0)}
    names = ["board"] if body == "board" else [ball.name for ball in balls]
    direction = np.array([math.cos(turn), math.sin(turn), 0])

    def speed() -> float:
        return float(np.mean([world.velocity(name) @ direction for name in names]))

    world.run(0.2, push)
    before = speed()
    world.run(0.6, push)
    return (speed() - before) / 0.6


def kept(**case: Any) -> float:
    """Nothing is lost or gained: elastic impacts keep the energy, and inner forces the momentum."""
    return 0.0


def bouncing(engine: Any, count: int, step: float) -> float:
    """Drop 25 elastic balls from different heights; return the mean relative change of energy after 4 s."""
    heights = [1.1 + 0.05 * i for i in range(count)]
    balls = [sphere(f"ball{i}", 0.1, (0.5 * i, 0, z), bounce=1.0) for i, z in enumerate(heights)]
    world = engine(Scene(tuple(balls), step=step))
    world.run(4.0)
    errors = []
    for ball, height in zip(balls, heights, strict=True):
        energy = kinetic_energy(world, ball.bodies[0]) + GRAVITY * (world.position(ball.name)[2] - 0.1)
        errors.append(abs(energy / (GRAVITY * (height - 0.1)) - 1))
    return float(np.mean(errors))


def apart(**case: Any) -> float:
    """Rigid bodies do not overlap."""
    return 0.0


def balls_666(engine: Any, step: float) -> float:
    """Let a cube of 6 x 6 x 6 balls without friction collapse; return the greatest overlap within 1 s, m."""
    rng = np.random.default_rng(6)
    places = [
        np.array([0.2 * (i - 2.5), 0.2 * (j - 2.5), 0.1 + 0.2 * k])
        for i in range(6)
        for j in range(6)
        for k in range(6)
    ]
    balls = []
    for i, place in enumerate(places):
        x, y, z = place * np.array([1.01, 1.01, 1.01]) + np.append(rng.uniform(-1e-3, 1e-3, 2), 0)
        balls.append(sphere(f"ball{i}", 0.1, (float(x), float(y), float(z)), mass=10.0, mu=0.0))
    world = engine(Scene(tuple(balls), step=step, substeps=round(0.05 / step)))
    deepest = 0.0
    for _ in range(20):
        world.run(0.05)
        centres = np.array([world.position(ball.name) for ball in balls])
        gaps = np.linalg.norm(centres[:, None] - centres[None], axis=2) + np.eye(len(balls))
        deepest = max(deepest, 0.2 - float(gaps.min()), 0.1 - float(centres[:, 2].min()))
    return deepest


def quadruped(motor: str) -> Model:
    """Return a torso with four legs of two joints each, 29 kg."""
    bodies = [Body("torso", 17.0, box_inertia(17.0, (0.6, 0.3, 0.15)), (Shape("box", (0.6, 0.3, 0.15)),))]
    joints = []
    for along, x in (("front", 0.3), ("hind", -0.3)):
        for side, y in (("left", 0.2), ("right", -0.2)):
            name = f"{along}_{side}"
            for part, parent, top, mass in (("thigh", "torso", 0.0, 2.0), ("shank", f"{name}_thigh", -0.25, 1.0)):
                place = (x, y, top - 0.125)
                bodies.append(Body(f"{name}_{part}", mass, box_inertia(mass, (0.05, 0.05, 0.25)), position=place))
                axis = (0.0, 1.0, 0.0)
                joints.append(
                    Joint(f"{name}_{part}_joint", "revolute", parent, f"{name}_{part}", axis, (x, y, top), motor)
                )
    return Model("robot", tuple(bodies), tuple(joints), (0, 0, 5))


def energy(engine: Any, step: float) -> float:
    """Swing the legs of a robot in space for 0.2 s; return the relative change of its energy in the next 2 s."""
    robot = quadruped("effort")
    world = engine(Scene((robot,), step=step, gravity=(0, 0, 0), ground=False))
    for i, joint in enumerate(robot.joints):
        world.set_target(joint.name, (1.0, -0.4, 0.7, 0.3)[i % 4])
    world.run(0.2)
    for joint in robot.joints:
        world.set_target(joint.name, 0.0)
    start = sum(kinetic_energy(world, body) for body in robot.bodies)
    world.run(2.0)
    return sum(kinetic_energy(world, body) for body in robot.bodies) / start - 1


def momentum(engine: Any, step: float) -> float:
    """Throw a ball of 10 kg against a robot in space; return the relative change of the momentum after 1 s."""
    robot = quadruped("")
    ball = sphere("ball", 0.15, (0.1, 1.5, 5.02), mass=10.0)
    world = engine(Scene((robot, ball), step=step, gravity=(0, 0, 0), ground=False))
    world.set_velocity("ball", (0, -5, 0))
    bodies = (*robot.bodies, *ball.bodies)

    def total() -> np.ndarray:
        return sum((body.mass * world.velocity(body.name) for body in bodies), np.zeros(3))

    start = total()
    world.run(1.0)
    moved = float(np.linalg.norm(world.velocity("torso")))
    return float(np.linalg.norm(total() - start) / np.linalg.norm(start)) if moved > 0.1 else math.inf


EXPERIMENTS = [
    Experiment(
        "sb_rolling",
        "SimBenchmark: 25 balls on a pushed board, acceleration, 1 ms",
        "m/s^2",
        rolling_theory,
        rolling,
        Tolerance("the net force is 8 % of the friction: 0.4 % of it", relative=0.05),
        product_of(body=("board", "balls"), heading=(0.0, 45.0)),
    ),
    Experiment(
        "sb_bouncing",
        "SimBenchmark: 25 elastic balls, relative change of energy in 4 s, 1 ms",
        "",
        kept,
        bouncing,
        Tolerance("four impacts: v dt / h = 0.3 % too deep, 2 g dt / v = 0.4 % off the speed", absolute=0.03),
        product_of(count=(25,), step=(0.001,)),
        peers=("PyBullet",),
    ),
    Experiment(
        "sb_666",
        "SimBenchmark: 216 balls without friction, greatest overlap, 5 ms",
        "m",
        apart,
        balls_666,
        Tolerance("v dt at 2 m/s and the compliance of a contact: 5 % of a diameter", absolute=0.01),
        product_of(step=(0.005,)),
    ),
    Experiment(
        "sb_energy",
        "SimBenchmark: robot with swinging legs, relative change of energy in 2 s, 1 ms",
        "",
        kept,
        energy,
        Tolerance("a first-order integrator: w dt = 1 %", absolute=0.01),
        product_of(step=(0.001,)),
    ),
    Experiment(
        "sb_momentum",
        "SimBenchmark: ball against a robot, relative change of momentum, 1 ms",
        "",
        kept,
        momentum,
        Tolerance("rounding of doubles", absolute=1e-10),
        product_of(step=(0.001,)),
    ),
]
