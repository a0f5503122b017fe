# SPDX-License-Identifier: BSD-3-Clause
"""Bodies that rotate freely."""

from __future__ import annotations

import dataclasses
import itertools
import math
from typing import Any

import numpy as np

from .experiment import Experiment, Tolerance, product_of
from .mechanics import (
    angular_momentum,
    complete_elliptic_integral,
    crossings,
    kinetic_energy,
    recorded,
    rotation,
    spin_in_body,
)
from .scene import GRAVITY, Body, Joint, Model, Scene, Shape, Vector, sphere_inertia, turned

TENNIS_RACKET = Body("racket", 1.0, (0.01, 0.02, 0.03))  # principal moments 1 : 2 : 3
START: Vector = (0.01, 5.0, 0.01)  # rad/s, nearly about the middle axis


def in_space(engine: Any, body: Body, spin: Vector, step: float) -> Any:
    """Return a world with one rotating body and no gravity."""
    world = engine(Scene((Model("top", (body,), position=(0, 0, 5)),), step=step, gravity=(0, 0, 0), ground=False))
    world.set_velocity(body.name, (0, 0, 0), spin)
    return world


def flip_interval(inertia: Vector, spin: Vector) -> float:
    """Return half the period of the middle component of a free rotation (Landau and Lifshitz, Mechanics, 37)."""
    i1, i2, i3 = inertia
    energy2 = sum(i * w * w for i, w in zip(inertia, spin, strict=True))
    square = sum((i * w) ** 2 for i, w in zip(inertia, spin, strict=True))
    if square < energy2 * i2:  # the rotation encloses the axis of the smallest moment
        i1, i3 = i3, i1
    rate = math.sqrt((i3 - i2) * (square - energy2 * i1) / (i1 * i2 * i3))
    modulus = math.sqrt((i2 - i1) * (energy2 * i3 - square) / ((i3 - i2) * (square - energy2 * i1)))
    return 2 * complete_elliptic_integral(modulus) / rate


def dzhanibekov_theory(step: float) -> float:
    """Half the period of sn(p t, k): 2 K(k) / p, from energy and momentum (Landau and Lifshitz, Mechanics, 37)."""
    return flip_interval(TENNIS_RACKET.inertia, START)


def dzhanibekov(engine: Any, step: float) -> float:
    """Return the interval between flips within 20 s that differs most from the theory."""
    world = in_space(engine, TENNIS_RACKET, START, step)
    times, middle = recorded(world, 20.0, step, lambda: spin_in_body(world, TENNIS_RACKET)[1])
    flips = crossings(times, middle)
    intervals = [b - a for a, b in itertools.pairwise(flips)]
    theory = dzhanibekov_theory(step)
    return max(intervals, key=lambda interval: abs(interval - theory), default=math.inf)


def unchanged(**case: Any) -> float:
    """Without torques the energy and the angular momentum of a body are constant (Euler's equations)."""
    return 0.0


def free_rotation(engine: Any, quantity: str, step: float) -> float:
    """Return the relative change of energy or momentum in 10 s."""
    world = in_space(engine, TENNIS_RACKET, START, step)

    def value() -> Any:
        if quantity == "energy":
            return kinetic_energy(world, TENNIS_RACKET)
        return angular_momentum(world, TENNIS_RACKET)

    start = value()
    world.run(10.0)
    return float(np.linalg.norm(value() - start) / np.linalg.norm(start))


def nutation_theory(spin: float) -> float:
    """The axis of a free symmetric top keeps its angle to the angular momentum (Euler): here atan(0.1)."""
    return math.degrees(math.atan(0.1))


def nutation(engine: Any, spin: float) -> float:
    """Return the angle after 20 s at 1 ms; moments 1 : 1 : 2."""
    disc = Body("disc", 1.0, (0.01, 0.01, 0.02))
    world = in_space(engine, disc, (0.1 * 2 * spin, 0, spin), 0.001)
    start = angular_momentum(world, disc)
    world.run(20.0)
    axis = rotation(world.orientation("disc"))[:, 2]
    return math.degrees(math.acos(float(axis @ start / np.linalg.norm(start))))


def precession_theory(spin: float) -> float:
    """The axis of a free symmetric top turns about the momentum at L / I1 (Euler); here L = I3 w3 / cos(5.71 deg)."""
    return 0.02 * spin / math.cos(math.atan(0.1)) / 0.01


def precession(engine: Any, spin: float) -> float:
    """Return the mean rate of the axis about the momentum in 2 s at 1 ms."""
    disc = Body("disc", 1.0, (0.01, 0.01, 0.02))
    world = in_space(engine, disc, (0.1 * 2 * spin, 0, spin), 0.001)
    momentum = angular_momentum(world, disc)
    up = momentum / np.linalg.norm(momentum)
    side = np.cross(up, (1.0, 0.0, 0.0))
    side /= np.linalg.norm(side)
    angles = []
    for _ in range(200):
        world.run(0.01)
        axis = rotation(world.orientation("disc"))[:, 2]
        angles.append(math.atan2(float(axis @ side), float(axis @ np.cross(side, up))))
    turns = np.unwrap(angles)
    return abs(float(turns[-1] - turns[0])) / 1.99


LENGTH, BOB = 1.0, Body("bob", 1.0, sphere_inertia(1.0, 0.05), (Shape("sphere", (0.05,)),))


def pendulum_theory(degrees: float, step: float) -> float:
    """T = 4 sqrt(I / (m g l)) K(sin(a / 2)), I = m l^2 + 0.4 m r^2 (any textbook on elliptic functions)."""
    inertia = BOB.mass * LENGTH**2 + BOB.inertia[1]
    return (
        4
        * math.sqrt(inertia / (BOB.mass * 9.81 * LENGTH))
        * complete_elliptic_integral(math.sin(math.radians(degrees) / 2))
    )


def swinging(engine: Any, degrees: float, step: float) -> Any:
    """Return a world with a pendulum, released at an angle to the vertical."""
    joint = Joint("hinge", "revolute", "world", "bob", (0, 1, 0), (0, 0, 0))
    bob = dataclasses.replace(BOB, position=(0.0, 0.0, -LENGTH))
    model = Model("pendulum", (bob,), (joint,), (0, 0, 3), turned((0, 1, 0), math.radians(degrees)))
    return engine(Scene((model,), step=step))


def pendulum(engine: Any, degrees: float, step: float) -> float:
    """Return the mean period of ten swings."""
    world = swinging(engine, degrees, step)
    times, rates = [], []
    for _ in range(round(12 * pendulum_theory(degrees, step) / step)):
        world.run(step)
        times.append(world.time)
        rates.append(float(world.joint_velocity("hinge")))
    turns = crossings(times, rates)[:21]
    return 2 * (turns[-1] - turns[0]) / (len(turns) - 1) if len(turns) > 2 else math.inf


def amplitude_theory(degrees: float, step: float) -> float:
    """A pendulum without friction reaches its first height again (conservation of energy)."""
    return degrees


def amplitude(engine: Any, degrees: float, step: float) -> float:
    """Return the angle reached in the eleventh swing."""
    world = swinging(engine, degrees, step)
    period = pendulum_theory(degrees, step)
    world.run(round(10 * period / step) * step)
    reached = 0.0
    for _ in range(round(1.2 * period / step)):
        world.run(step)
        reached = max(reached, 180 - math.degrees(angle_to_top(world.position("bob"))))
    return reached


def angle_to_top(place: np.ndarray) -> float:
    """Return the angle between the pendulum and the upward vertical."""
    arm = place - np.array([0, 0, 3.0])
    return math.acos(float(arm[2] / np.linalg.norm(arm)))


DISC, LEAN = 0.1, math.radians(30)  # m, angle of the disc to the floor


def rolling_disc_theory(step: float) -> float:
    """W^2 = 4 g / (r sin a): a thin disc rolls on its rim while its centre stands (Moffatt, Nature 404, 2000)."""
    return math.sqrt(4 * GRAVITY / (DISC * math.sin(LEAN)))


def rolling_disc(engine: Any, step: float) -> float:
    """Return the mean rate at which the axis goes round in half a second."""
    thickness = 0.001
    disc = Body("disc", 1.0, (DISC**2 / 4, DISC**2 / 4, DISC**2 / 2), (Shape("cylinder", (DISC, thickness)),))
    height = DISC * math.sin(LEAN) + thickness / 2 * math.cos(LEAN)
    world = engine(Scene((Model("disc", (disc,), (), (0, 0, height), turned((0, 1, 0), LEAN)),), step=step))
    axis = np.array([math.sin(LEAN), 0, math.cos(LEAN)])
    spin = rolling_disc_theory(step) * (np.array([0, 0, 1]) - math.cos(LEAN) * axis)  # along the radius to the floor
    world.set_velocity("disc", (0, 0, 0), (float(spin[0]), float(spin[1]), float(spin[2])))

    def heading() -> float:
        x, y, _ = rotation(world.orientation("disc"))[:, 2]
        return math.atan2(y, x)

    times, headings = recorded(world, 0.5, 0.005, heading)
    turns = np.unwrap(headings)
    return float(turns[-1] - turns[0]) / (times[-1] - times[0])


EXPERIMENTS = [
    Experiment(
        "pendulum",
        "Pendulum, mean period of ten swings",
        "s",
        pendulum_theory,
        pendulum,
        Tolerance("a second-order integrator at 5 ms: (w dt)^2", relative=0.005),
        product_of(degrees=(30.0, 90.0, 170.0), step=(0.005,)),
    ),
    Experiment(
        "amplitude",
        "Pendulum, angle of the eleventh swing",
        "deg",
        amplitude_theory,
        amplitude,
        Tolerance("energy oscillates within a swing by w dt / 2 = 0.8 %", relative=0.01),
        product_of(degrees=(30.0, 90.0, 170.0), step=(0.005,)),
    ),
    Experiment(
        "dzhanibekov",
        "Dzhanibekov effect, interval between flips, worst of 20 s, 1 ms",
        "s",
        dzhanibekov_theory,
        dzhanibekov,
        Tolerance("the interval depends on the logarithm of the small components, which drift", relative=0.05),
        product_of(step=(0.001,)),
    ),
    Experiment(
        "free_rotation",
        "Free rotation, relative change in 10 s, 1 ms",
        "",
        unchanged,
        free_rotation,
        Tolerance("a second-order integrator: some (w dt)^2 at each flip", absolute=0.001),
        product_of(quantity=("energy", "angular momentum"), step=(0.001,)),
    ),
    Experiment(
        "nutation",
        "Nutation of a disc, angle after 20 s, 1 ms",
        "deg",
        nutation_theory,
        nutation,
        Tolerance("energy drift of the integrator", relative=0.05),
        product_of(spin=(10.0, 30.0)),
    ),
    Experiment(
        "precession",
        "Free precession of a disc, rate, 1 ms",
        "rad/s",
        precession_theory,
        precession,
        Tolerance("(w dt)^2 / 12 of a second-order integrator, and the drift of the spin", relative=0.01),
        product_of(spin=(10.0, 30.0)),
    ),
    Experiment(
        "rolling_disc",
        "Euler's disc at 30 degrees, rate of its axis, 0.2 and 1 ms",
        "rad/s",
        rolling_disc_theory,
        rolling_disc,
        Tolerance("a first-order integrator raises the disc, by W dt = 2.8 % of the sine at 1 ms", relative=0.05),
        product_of(step=(0.0002, 0.001)),
    ),
]
