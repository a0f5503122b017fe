# SPDX-License-Identifier: BSD-3-Clause
"""Coulomb friction under loads that change and in any direction."""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from .experiment import Experiment, Tolerance, lowest, product_of
from .mechanics import rate_of
from .scene import (
    GRAVITY,
    Body,
    Joint,
    Model,
    Scene,
    Shape,
    box,
    box_inertia,
    roller,
    sphere_inertia,
    tilted,
    turned,
)


def incline_theory(mu: float, heading: float, yaw: float) -> float:
    """tan(s) = mu (Coulomb), whatever the direction of the slope and of the box."""
    return math.degrees(math.atan(mu))


def incline(engine: Any, mu: float, heading: float, yaw: float) -> float:
    """Return the least slope at which a box slides by a centimetre in 1.2 s (0.1 degrees steeper: 1.5 cm)."""

    def slides(slope: float) -> bool:
        flat = box("box", (0.4, 0.4, 0.1), (0, 0, 0.05), mu=mu, orientation=turned((0, 0, 1), math.radians(yaw)))
        world = engine(Scene((flat,), gravity=tilted(slope, heading)))
        world.run(0.2)
        start = world.position("box")
        world.run(1.2)
        return float(np.linalg.norm(world.position("box") - start)) > 0.01

    angle = incline_theory(mu, heading, yaw)
    return lowest(slides, angle - 3, angle + 13, 0.05)


def sliding_theory(heading: float) -> float:
    """a = g (sin s - mu cos s) (Coulomb), here with s = 35 degrees and mu = 0.5."""
    s = math.radians(35)
    return GRAVITY * (math.sin(s) - 0.5 * math.cos(s))


def sliding(engine: Any, heading: float) -> float:
    """Return the acceleration of a box on a slope."""
    world = engine(Scene((box("box", (0.4, 0.4, 0.1), (0, 0, 0.05), mu=0.5),), gravity=tilted(35, heading)))
    world.run(0.3)
    return float(np.linalg.norm(rate_of(world, 0.5, lambda: world.velocity("box"))))


FOOT = 0.005  # m, radius of the ladder's feet


def ladder_theory(mu: float) -> float:
    """The steepest friction at floor and wall: tan(a) = (1 - mu^2) / (2 mu) for feet without size (any textbook).

    With feet of radius r at the half length l: (1 - mu^2) l cos a = 2 mu l sin a + mu (1 + mu) r.
    """
    return lowest(
        lambda a: (
            (1 - mu**2) * math.cos(math.radians(a)) <= 2 * mu * math.sin(math.radians(a)) + mu * (1 + mu) * FOOT / 1.0
        ),
        0.0,
        89.0,
        1e-9,
    )


def ladder(engine: Any, mu: float) -> float:
    """Return the least angle to the floor at which a ladder of 2 m stands."""

    def stands(degrees: float) -> bool:
        angle = math.radians(degrees)
        feet = tuple(Shape("sphere", (FOOT,), (x, y, 0)) for x in (-1, 1) for y in (-0.2, 0.2))
        rod = Body("rod", 5.0, (0.07, 5.0 / 3, 5.0 / 3 + 0.07), feet, mu=mu)
        model = Model(
            "ladder",
            (rod,),
            position=(-math.cos(angle) - FOOT, 0, math.sin(angle) + FOOT),
            orientation=turned((0, 1, 0), -angle),
        )
        world = engine(Scene((model, box("wall", (0.2, 2, 4), (0.1, 0, 2), static=True))))
        world.run(2.0)
        return bool(abs(world.position("rod")[2] - math.sin(angle) - FOOT) < 0.05)

    return lowest(stands, 2.0, 70.0, 0.2)


def jaws_theory(load: float, mu: float) -> float:
    """A box of weight W between two jaws of force F does not slip while W < 2 mu F (Coulomb)."""
    return 0.0


def jaws(engine: Any, load: float, mu: float) -> float:
    """Return how far a box of 1 kg falls in 2 s, in m; `load` is W / (2 mu F)."""
    force = GRAVITY / (2 * mu * load)
    held = box("held", (0.1, 0.1, 0.1), (0, 0, 1), mu=mu)
    jaw = Shape("box", (0.02, 0.1, 0.1))
    models = [held]
    for name, side in (("right", 1.0), ("left", -1.0)):
        place = (0.06 * side, 0.0, 0.0)
        body = Body(name, 2.0, box_inertia(2.0, (0.02, 0.1, 0.1)), (jaw,), position=place)
        slide = Joint(f"{name}_slide", "prismatic", "world", name, (-side, 0, 0), place, "velocity", force)
        models.append(Model(f"{name}_jaw", (body,), (slide,), (0, 0, 1)))
    world = engine(Scene(tuple(models), ground=False))
    for name in ("right", "left"):
        world.set_target(f"{name}_slide", 0.1)
    world.run(2.0)
    return float(1 - world.position("held")[2])


PAD = 0.04  # m, side of a square pad


def pads_theory(load: float) -> float:
    """The least over all points c of c + sum |p - c| / (4 load): the bar would turn about c (the upper bound theorem).

    Two square pads, each pressed by F, bear with their corners p. `load` is W / (2 mu F); a weight W at the distance d
    turns the bar about c once W (d - c) is 2 mu F times the mean distance of the corners from c.
    """
    places = np.linspace(-2, PAD / 3, 200001)
    corners = [(x, z) for x in (-PAD / 2, PAD / 2) for z in (-PAD / 2, PAD / 2)]
    distances = np.mean([np.hypot(x - places, z) for x, z in corners], axis=0)
    return float(np.min(places + distances / load))


def pads(engine: Any, load: float) -> float:
    """Return how far from its centre a bar of 1 kg can be held by two pads."""
    force = GRAVITY / (2 * 0.8 * load)
    size = (1.0, 0.04, 2 * PAD)

    def turns(distance: float) -> bool:
        models = [box("bar", size, (distance, 0, 1), mu=0.8)]
        for name, side in (("left", 1.0), ("right", -1.0)):
            place = (0.0, 0.03 * side, 0.0)
            pad = Body(name, 2.0, box_inertia(2.0, (PAD, 0.02, PAD)), (Shape("box", (PAD, 0.02, PAD)),), place, 0.8)
            slide = Joint(f"{name}_slide", "prismatic", "world", name, (0, -side, 0), place, "velocity", force)
            models.append(Model(f"{name}_pad", (pad,), (slide,), (0, 0, 1)))
        world = engine(Scene(tuple(models), ground=False))
        for name in ("left", "right"):
            world.set_target(f"{name}_slide", 0.1)
        world.run(1.0)
        lean = 2 * math.asin(min(1.0, abs(float(world.orientation("bar")[1]))))
        return lean > math.radians(1) or float(world.position("bar")[2]) < 0.99

    theory = pads_theory(load)
    return lowest(turns, 0.3 * theory, 1.5 * theory, 0.005 * theory)


def torsion_theory(coefficient: float, patch: float) -> float:
    """A Hertzian contact of radius a resists by 3 pi / 16 mu a N (Gazebo's model of torsional friction).

    A ball of 1 kg and 0.1 m then slows down by 3 pi / 16 mu a g / (0.4 r^2).
    """
    return 3 * math.pi / 16 * coefficient * patch * GRAVITY / (0.4 * 0.1**2)


def torsion(engine: Any, coefficient: float, patch: float) -> float:
    """Return the deceleration of a ball that spins about the normal."""
    surface = f"<torsional><coefficient>{coefficient}</coefficient><patch_radius>{patch}</patch_radius></torsional>"
    ball = Body("ball", 1.0, sphere_inertia(1.0, 0.1), (Shape("sphere", (0.1,)),), mu=1.0, torsional=surface)
    world = engine(Scene((Model("ball", (ball,), position=(0, 0, 0.1)),)))
    world.run(0.2)
    world.set_velocity("ball", (0, 0, 0), (0, 0, 50))
    world.run(0.05)
    return -float(rate_of(world, 0.1, lambda: world.spin("ball")[2]))


def rolling_theory(shape: str, heading: float, coefficient: float, jointed: bool) -> float:
    """The torque k N against rolling slows a body by k g / (r (1 + I / (m r^2))) (any textbook); here r = 0.1 m."""
    return coefficient * GRAVITY / (0.1 * (1.4 if shape == "sphere" else 1.5))


def rolling(engine: Any, shape: str, heading: float, coefficient: float, jointed: bool) -> float:
    """Return the deceleration of a rolling body against its direction."""
    world = engine(Scene((roller(shape, heading, mu=0.8, rolling=coefficient, jointed=jointed),)))
    world.run(0.2)
    way = np.array((math.cos(math.radians(heading)), math.sin(math.radians(heading)), 0))
    world.set_velocity("body", tuple(3 * way), (-30 * way[1], 30 * way[0], 0))
    world.run(0.2)
    return -float(rate_of(world, 0.5, lambda: way @ world.velocity("body")))


def holding_theory(heading: float, jointed: bool) -> float:
    """tan(s) = k / r (any textbook), here with k = 1 cm and r = 10 cm."""
    return math.degrees(math.atan(0.1))


def holding(engine: Any, heading: float, jointed: bool) -> float:
    """Return the least slope at which a ball rolls by a centimetre in 1.2 s (0.2 degrees steeper: 1.5 cm)."""

    def rolls(slope: float) -> bool:
        model = roller("sphere", heading, mu=0.8, rolling=0.01, jointed=jointed)
        world = engine(Scene((model,), gravity=tilted(slope, heading)))
        world.run(0.2)
        start = world.position("body")
        world.run(1.2)
        return float(np.linalg.norm(world.position("body") - start)) > 0.01

    angle = holding_theory(heading, jointed)
    return lowest(rolls, angle - 3, angle + 3, 0.05)


SOFT = "bisection to 0.05 and a creep of a centimetre"
EXPERIMENTS = [
    Experiment(
        "incline",
        "Incline in any direction, least slope",
        "deg",
        incline_theory,
        incline,
        Tolerance(SOFT, absolute=0.2),
        product_of(mu=(0.5,), heading=(0.0, 15.0, 30.0, 45.0, 60.0, 90.0), yaw=(0.0, 20.0))
        + product_of(mu=(0.2, 0.8), heading=(0.0, 45.0), yaw=(0.0,)),
    ),
    Experiment(
        "sliding",
        "Sliding down 35 degrees in any direction, mu 0.5, acceleration",
        "m/s^2",
        sliding_theory,
        sliding,
        Tolerance("half of the friction law's error at the limit", relative=0.02),
        product_of(heading=(0.0, 22.5, 45.0, 70.0)),
    ),
    Experiment(
        "ladder",
        "Ladder against a wall, least angle",
        "deg",
        ladder_theory,
        ladder,
        Tolerance("bisection to 0.2 and a fall of 5 cm in 2 s", absolute=1.0),
        product_of(mu=(0.5, 0.8)),
    ),
    Experiment(
        "jaws",
        "Box between two jaws, 40 loads of 5 to 95 %, slip in 2 s",
        "m",
        jaws_theory,
        jaws,
        Tolerance("compliance of the friction", absolute=0.001),
        tuple({"load": round(0.05 + 0.9 * i / 39, 4), "mu": (0.3, 0.5, 0.8, 1.0)[i % 4]} for i in range(40)),
    ),
    Experiment(
        "torsion",
        "Torsional friction of a spinning ball, deceleration",
        "rad/s^2",
        torsion_theory,
        torsion,
        Tolerance("the load of one contact", relative=0.03),
        ({"coefficient": 0.5, "patch": 0.02}, {"coefficient": 1.0, "patch": 0.01}),
        peers=(),
    ),
    Experiment(
        "rolling_resistance",
        "Resistance to rolling in any direction, deceleration",
        "m/s^2",
        rolling_theory,
        rolling,
        Tolerance("contact penetration shortens the lever by 1 mm of 100", relative=0.02),
        product_of(shape=("sphere",), heading=(0.0, 30.0, 45.0), coefficient=(0.002, 0.01), jointed=(False, True))
        + product_of(shape=("cylinder",), heading=(0.0, 45.0), coefficient=(0.005,), jointed=(False, True)),
        peers=("MuJoCo",),
    ),
    Experiment(
        "pads",
        "Bar between two pads, greatest distance of its centre",
        "m",
        pads_theory,
        pads,
        Tolerance("bisection to 0.5 %, and 0.7 mm of slip before it turns", absolute=0.0007, relative=0.01),
        product_of(load=(0.2, 0.5, 0.9)),
    ),
    Experiment(
        "rolling_slope",
        "Ball with resistance to rolling on a slope, least slope",
        "deg",
        holding_theory,
        holding,
        Tolerance("bisection to 0.05 and a way of a centimetre", absolute=0.3),
        product_of(heading=(0.0, 30.0, 45.0), jointed=(False, True)),
        peers=("MuJoCo",),
    ),
]
