# SPDX-License-Identifier: BSD-3-Clause
"""Bodies at rest on each other, and bodies that must not pass through each other."""

from __future__ import annotations

import dataclasses
import math
from typing import Any

import numpy as np

from .experiment import Experiment, Tolerance, product_of
from .mechanics import recorded
from .scene import ZERO, Model, Scene, box, sphere, turned


def rest(**case: Any) -> float:
    """Bodies at rest stay at rest (Newton's first law): the configuration is stable, friction is more than enough."""
    return 0.0


def displacement(world: Any, names: list[str], seconds: float, settle: float) -> float:
    """Return the longest way of a body from its place after `settle` until the end, looked at each second."""
    world.run(settle)
    places = [world.position(name) for name in names]
    farthest = 0.0
    for _ in range(round(seconds)):
        world.run(1.0)
        now = max(float(np.linalg.norm(world.position(n) - p)) for n, p in zip(names, places, strict=True))
        farthest = max(farthest, now)
        if not now < 10:
            return math.inf
    return farthest


def stack(engine: Any, count: int, seconds: float) -> float:
    """Stack cubes of 0.2 m and 1 kg."""
    cubes = tuple(box(f"cube{i}", (0.2, 0.2, 0.2), (0, 0, 0.1 + 0.2 * i), mu=0.8) for i in range(count))
    world = engine(Scene(cubes, substeps=10))
    return displacement(world, [cube.name for cube in cubes], seconds, 1.0)


def mesh_stack(engine: Any, count: int, seconds: float) -> float:
    """Stack cubes of 0.2 m whose shapes are triangle meshes, each turned a little."""
    cubes = tuple(
        box(
            f"cube{i}",
            (0.2, 0.2, 0.2),
            (0.01 * (i % 2), 0, 0.1 + 0.2 * i),
            mu=0.8,
            mesh=True,
            orientation=turned((0, 0, 1), 0.2 * i),
        )
        for i in range(count)
    )
    world = engine(Scene(cubes, substeps=10))
    return displacement(world, [cube.name for cube in cubes], seconds, 0.0)


def bin_walls(half: float, height: float) -> tuple[Model, ...]:
    """Return four walls around the origin."""
    thick = 0.2
    size = {"x": (thick, 2 * half + 2 * thick, height), "y": (2 * half + 2 * thick, thick, height)}
    return tuple(
        box(
            f"wall_{axis}{side}",
            size[axis],
            (
                (half + thick / 2) * side if axis == "x" else 0,
                (half + thick / 2) * side if axis == "y" else 0,
                height / 2,
            ),
            static=True,
        )
        for axis in "xy"
        for side in (-1, 1)
    )


def pile(engine: Any, shape: str, count: int) -> float:
    """Drop spheres of 0.1 m into a bin of 0.6 m, or boxes onto the ground; return the greatest speed after 5 s."""
    rng = np.random.default_rng(5)
    bodies = []
    apart = 0.14 if shape == "sphere" else 0.18
    for i in range(count):
        layer, place = divmod(i, 16)
        x, y = (0.14 * (k - 1.5) for k in divmod(place, 4))
        where = (x + rng.uniform(-0.01, 0.01), y + rng.uniform(-0.01, 0.01), 0.1 + apart * layer)
        if shape == "box":
            q = rng.normal(size=4)
            x, y, z, w = (float(value) for value in q / np.linalg.norm(q))
            bodies.append(box(f"body{i}", (0.1, 0.1, 0.1), where, mass=0.5, mu=0.6, orientation=(x, y, z, w)))
        else:
            bodies.append(sphere(f"body{i}", 0.05, where, mass=0.5, mu=0.6))
    world = engine(Scene((*(bin_walls(0.3, 3.0) if shape == "sphere" else ()), *bodies), substeps=2))
    world.run(4.9)
    fastest = 0.0
    for _ in range(10):
        world.run(0.01)
        fastest = max(fastest, *(float(np.linalg.norm(world.velocity(body.name))) for body in bodies))
    return fastest


PHASES = 8  # where in a physics substep of 5 ms a body meets a wall


def shot(engine: Any, body: Model, wall: Model, speed: float, phase: int) -> Any:
    """Return a world in which a body of 0.1 m flies along x at a wall in the origin, from about a metre away."""
    start = (-1.0 - phase * speed * 0.005 / PHASES, 0.0, 1.0)
    world = engine(Scene((dataclasses.replace(body, position=start), wall), gravity=(0, 0, 0), ground=False))
    world.set_velocity(body.name, (speed, 0, 0))
    return world


def impact(engine: Any, shape: str, speed: float, thickness: float, wall: str = "box") -> float:
    """Shoot a body of 0.1 m at a wall from eight distances; return the deepest penetration of its centre's plane."""
    bullet = sphere("bullet", 0.05, ZERO) if shape == "sphere" else box("bullet", (0.1, 0.1, 0.1), ZERO)
    barrier = box("wall", (thickness, 2, 2), (thickness / 2, 0, 1), static=True, mesh=wall == "mesh")

    def deepest(phase: int) -> float:
        world = shot(engine, bullet, barrier, speed, phase)
        _, places = recorded(world, 1.5 / speed + 0.1, 0.005, lambda: world.position("bullet")[0])
        return max(places) + 0.05

    return max(map(deepest, range(PHASES)))


def fast_bounce_theory(speed: float, thickness: float) -> float:
    """Newton's restitution at any speed: here e = 0.5."""
    return 0.5


def fast_bounce(engine: Any, speed: float, thickness: float) -> float:
    """Shoot an elastic ball at a wall from eight distances; return the worst ratio of the speeds after and before."""
    ball = sphere("ball", 0.05, ZERO, bounce=0.5)
    barrier = box("wall", (thickness, 2, 2), (thickness / 2, 0, 1), static=True, bounce=1.0)
    ratios = []
    for phase in range(PHASES):
        world = shot(engine, ball, barrier, speed, phase)
        world.run(round(1.5 / speed / 0.005 + 10) * 0.005)
        ratios.append(-float(world.velocity("ball")[0]) / speed)
    return max(ratios, key=lambda ratio: abs(ratio - 0.5))


EXPERIMENTS = [
    Experiment(
        "stack_10",
        "Stack of 10 cubes, 60 s at 5 ms, displacement",
        "m",
        rest,
        stack,
        Tolerance("overlap of the contacts", absolute=0.002),
        ({"count": 10, "seconds": 60.0},),
    ),
    Experiment(
        "stack_20",
        "Stack of 20 cubes, 60 s at 5 ms, displacement",
        "m",
        rest,
        stack,
        Tolerance("it stands while each cube is over the one below; a fifth of a cube", absolute=0.04),
        ({"count": 20, "seconds": 60.0},),
    ),
    Experiment(
        "stack_20_long",
        "Stack of 20 cubes, 10 minutes at 5 ms, displacement",
        "m",
        rest,
        stack,
        Tolerance("it stands while each cube is over the one below; a fifth of a cube", absolute=0.04),
        ({"count": 20, "seconds": 600.0},),
        long=True,
    ),
    Experiment(
        "mesh_cubes",
        "Four mesh cubes on each other, 60 s at 5 ms, displacement from the start",
        "m",
        rest,
        mesh_stack,
        Tolerance("up to a millimetre of overlap in each of four contacts", absolute=0.005),
        ({"count": 4, "seconds": 60.0},),
    ),
    Experiment(
        "pile",
        "Pile of 200 bodies, greatest speed 5 s after the drop",
        "m/s",
        rest,
        pile,
        Tolerance("0.2 mm of motion in a step of 10 ms", absolute=0.02),
        product_of(shape=("sphere", "box"), count=(200,)),
    ),
    Experiment(
        "impact",
        "Body of 0.1 m against a wall at 5 ms, penetration",
        "m",
        rest,
        impact,
        Tolerance("its centre stays on its side; slow bodies overlap by v dt = 1 cm", absolute=0.05),
        (
            {"shape": "sphere", "speed": 20.0, "thickness": 0.05},
            {"shape": "box", "speed": 20.0, "thickness": 0.05},
            {"shape": "sphere", "speed": 20.0, "thickness": 0.05, "wall": "mesh"},
            {"shape": "sphere", "speed": 60.0, "thickness": 0.01},
            {"shape": "sphere", "speed": 2.0, "thickness": 0.05},
        ),
    ),
    Experiment(
        "fast_bounce",
        "Ball of 0.1 m against a wall at 5 ms, speed after over speed before",
        "",
        fast_bounce_theory,
        fast_bounce,
        Tolerance("the correction of the overlap", relative=0.01),
        ({"speed": 5.0, "thickness": 0.05}, {"speed": 20.0, "thickness": 0.05}, {"speed": 60.0, "thickness": 0.01}),
        peers=("PyBullet",),
    ),
]
