# SPDX-License-Identifier: BSD-3-Clause
"""Free fall, impact, rolling, and the quantities that motion keeps."""

from __future__ import annotations

import math
from itertools import pairwise
from typing import Any

import numpy as np

from .experiment import Experiment, Tolerance, lowest, product_of
from .mechanics import rate_of, recorded
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
    sphere,
    sphere_inertia,
    tilted,
    turned,
)


def falling_theory(seconds: float) -> float:
    """z = z0 + v0 t - g t^2 / 2 (Galilei), here with z0 = 100 m and v0 = 3 m/s."""
    return 100 + 3 * seconds - GRAVITY * seconds**2 / 2


def falling(engine: Any, seconds: float) -> float:
    """Throw a sphere upwards."""
    world = engine(Scene((sphere("ball", 0.1, (0, 0, 100)),), step=0.001))
    world.set_velocity("ball", (0, 0, 3))
    world.run(seconds)
    return float(world.position("ball")[2])


def bounce_theory(restitution: float, step: float) -> float:
    """Newton's restitution: the speed after the impact is e times that before it, whatever the step."""
    return restitution


def bounce(engine: Any, restitution: float, step: float) -> float:
    """Drop a ball from a metre; return the ratio of the speeds."""
    world = engine(Scene((sphere("ball", 0.1, (0, 0, 1.1), bounce=restitution),), step=step))
    _, speeds = recorded(world, 1.0, step, lambda: world.velocity("ball")[2])
    return max(0.0, *speeds) / -min(speeds)


def turntable_theory(table: str, step: float) -> float:
    """A ball that rolls on a turntable runs in a circle at 2/7 of its rate (E. A. Milne, Vectorial Mechanics, 1948)."""
    return 2 / 7


def turntable(engine: Any, table: str, step: float) -> float:
    """Return the rate of the ball's circle, in that of the table: 1 rad/s."""
    size = (2.0, 0.1) if table == "cylinder" else (4.0, 4.0, 0.1)
    disc = Body("disc", 100.0, (100.0, 100.0, 200.0), (Shape(table, size),))
    spindle = Joint("spindle", "revolute", "world", "disc", (0, 0, 1), (0, 0, 0), "velocity", 1e4)
    ball = Model(
        "ball",
        (Body("ball", 1.0, sphere_inertia(1.0, 0.1), (Shape("sphere", (0.1,)),), mu=1.0),),
        position=(0.5, 0, 0.1),
    )
    world = engine(Scene((Model("table", (disc,), (spindle,), (0, 0, -0.05)), ball), ground=False, step=step))
    world.set_target("spindle", 1.0)
    world.run(0.5)
    x, y, _ = world.position("ball")
    world.set_velocity("ball", (0.3, 0, 0), (x / 0.1, (0.3 + y) / 0.1, 0))  # as fast as the table where they touch
    headings = []
    for _ in range(31):
        world.run(0.1)
        velocity = world.velocity("ball")
        headings.append(math.atan2(velocity[1], velocity[0]))
    turns = [math.remainder(after - before, 2 * math.pi) for before, after in pairwise(headings)]
    return sum(turns) / 3.0


def rolling_theory(shape: str, heading: float) -> float:
    """a = g sin(s) / (1 + I / (m r^2)): 5/7 g sin s for a sphere, 2/3 for a cylinder (any textbook); s = 10 degrees."""
    return GRAVITY * math.sin(math.radians(10)) / (1.4 if shape == "sphere" else 1.5)


def rolling(engine: Any, shape: str, heading: float) -> float:
    """Let a body roll down a slope, which is a tilted gravity; return its acceleration."""
    world = engine(Scene((roller(shape, heading),), gravity=tilted(10, heading)))
    world.run(0.5)
    return float(rate_of(world, 1.0, lambda: np.linalg.norm(world.velocity("body")[:2])))


def skidding_theory(mu: float) -> float:
    """A ball that slides without spin ends rolling at 5/7 of its speed: L about a point of the ground is kept."""
    return 2 * 5 / 7


def skidding(engine: Any, mu: float) -> float:
    """Throw a ball along the ground at 2 m/s and 30 degrees to the axes."""
    world = engine(Scene((sphere("ball", 0.1, (0, 0, 0.1), mu=mu),)))
    world.run(0.2)
    world.set_velocity("ball", (2 * math.cos(0.5), 2 * math.sin(0.5), 0))
    world.run(2.0)
    return float(np.linalg.norm(world.velocity("ball")[:2]))


def tipping_theory(heading: float) -> float:
    """A box of width w and height h that cannot slide tips over where tan(s) = w / h: here 0.2 / 0.4."""
    return math.degrees(math.atan2(0.2, 0.4))


def tipping(engine: Any, heading: float) -> float:
    """Tilt gravity until the box falls."""

    def falls(slope: float) -> bool:
        facing = turned((0, 0, 1), math.radians(heading))
        tall = box("tall", (0.2, 0.2, 0.4), (0, 0, 0.2), mu=5, orientation=facing)
        world = engine(Scene((tall,), gravity=tilted(slope, heading)))
        world.run(3.0)
        return float(world.position("tall")[2]) < 0.15

    return lowest(falls, 20.0, 35.0, 0.05)


def zero(**case: Any) -> float:
    """Nothing acts from outside: the sums of m v and of r x m v + I w do not change (Newton, Euler)."""
    return 0.0


def momentum(engine: Any, quantity: str) -> float:
    """Let two boxes and a ball collide off their centres without gravity; return the relative change."""
    models = (
        box("a", (0.3, 0.2, 0.1), (-1, 0.05, 0.02), mass=2.0, mu=0.3),
        box("b", (0.2, 0.2, 0.2), (1, 0, 0), mass=5.0, mu=0.3),
        sphere("c", 0.1, (0, -1, 0.05), mass=1.0, mu=0.3, bounce=0.5),
    )
    world = engine(Scene(models, step=0.001, gravity=(0, 0, 0), ground=False))
    world.set_velocity("a", (2, 0, 0), (0.3, 0.2, 0.1))
    world.set_velocity("b", (-1, 0, 0))
    world.set_velocity("c", (0, 2, 0))

    def total() -> np.ndarray:
        return sum(model.bodies[0].mass * world.velocity(model.name) for model in models)

    start, scale = total(), sum(m.bodies[0].mass * np.linalg.norm(world.velocity(m.name)) for m in models)
    world.run(2.0)
    if quantity == "speed of c":
        return float(np.linalg.norm(world.velocity("c")))
    return float(np.linalg.norm(total() - start) / scale)


def pushed_theory(mass: float) -> float:
    """Newton: v = F t / m, and x = F t^2 / (2 m); here v after 1 s at 12 N."""
    return 12.0 / mass


def pushed(engine: Any, mass: float) -> float:
    """Push a body in space at its centre of mass."""
    world = engine(Scene((box("body", (0.2, 0.2, 0.2), (0, 0, 5), mass=mass),), gravity=(0, 0, 0), ground=False))
    world.run(1.0, {"body": (12.0, 0, 0)})
    return float(world.velocity("body")[0])


def wrench_theory(quantity: str) -> float:
    """F = m a and T + r x F = I dw/dt (Newton, Euler), from rest for 0.05 s, in which a body turns by 0.1 degrees."""
    force, torque, lever, inertia = 3.0, 0.02, 0.1, box_inertia(2.0, (0.4, 0.4, 0.4))[2]
    return 0.05 * (force / 2.0 if quantity == "speed" else (torque + lever * force) / inertia)


def wrench(engine: Any, quantity: str) -> float:
    """Push a cube of 2 kg beside its centre of mass and turn it; return its speed or its spin."""
    world = engine(Scene((box("cube", (0.4, 0.4, 0.4), (0, 0, 5), mass=2.0),), gravity=(0, 0, 0), ground=False))
    for _ in range(10):
        x, y, z = world.position("cube")
        world.links["cube"].apply_wrench((0, 3.0, 0), (0, 0, 0.02), point=(x + 0.1, y, z))
        world.run(0.005)
    return float(world.velocity("cube")[1] if quantity == "speed" else world.spin("cube")[2])


EXPERIMENTS = [
    Experiment(
        "free_fall",
        "Free fall, height after 0.5 and 2 s, 1 ms",
        "m",
        falling_theory,
        falling,
        Tolerance("semi-implicit Euler is g t dt / 2 below: 9.8 mm at 2 s", absolute=0.010),
        product_of(seconds=(0.5, 2.0)),
    ),
    Experiment(
        "bounce",
        "Bounce, speed after over speed before",
        "",
        bounce_theory,
        bounce,
        Tolerance("the speed before the impact is that of a whole step: g dt / v = 1 % at 5 ms", relative=0.012),
        product_of(restitution=(0.3, 0.6, 0.9), step=(0.001, 0.005)),
        peers=("PyBullet",),
    ),
    Experiment(
        "turntable",
        "Ball on a turntable, rate of its circle over that of the table",
        "",
        turntable_theory,
        turntable,
        Tolerance("the ball falls outwards by v dt / 2 in a substep", relative=1e-3),
        product_of(table=("box", "cylinder", "mesh"), step=(0.005, 0.001)),
    ),
    Experiment(
        "rolling",
        "Rolling down 10 degrees in any direction, acceleration",
        "m/s^2",
        rolling_theory,
        rolling,
        Tolerance("contact penetration shortens the lever by 1 mm of 100", relative=0.02),
        product_of(shape=("sphere", "cylinder"), heading=(0.0, 30.0, 45.0)),
    ),
    Experiment(
        "skidding",
        "Skidding ball of 2 m/s, speed when it rolls",
        "m/s",
        skidding_theory,
        skidding,
        Tolerance("contact penetration shortens the lever by 1 mm of 100", relative=0.02),
        product_of(mu=(0.2, 0.5)),
    ),
    Experiment(
        "tipping",
        "Tipping over, least slope",
        "deg",
        tipping_theory,
        tipping,
        Tolerance("bisection to 0.05; the edge sinks in by up to 1 mm of 200: 0.3", absolute=0.4),
        product_of(heading=(0.0, 45.0, 90.0)),
    ),
    Experiment(
        "momentum",
        "Momentum after collisions, relative change",
        "",
        zero,
        momentum,
        Tolerance("rounding of doubles over 2000 steps", absolute=1e-10),
        product_of(quantity=("linear",)),
    ),
    Experiment(
        "push",
        "Velocity after a constant force",
        "m/s",
        pushed_theory,
        pushed,
        Tolerance("rounding of doubles", relative=1e-9),
        product_of(mass=(0.1, 3.0, 1000.0)),
    ),
    Experiment(
        "wrench",
        "Speed and spin after a force beside the centre of mass and a torque",
        "m/s, rad/s",
        wrench_theory,
        wrench,
        Tolerance("rounding of doubles", relative=1e-9),
        product_of(quantity=("speed", "spin")),
        peers=(),
    ),
]
