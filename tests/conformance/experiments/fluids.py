# SPDX-License-Identifier: BSD-3-Clause
"""Drag, buoyancy, wings and propellers. Only bubblesim has these forces."""

from __future__ import annotations

import math
from typing import Any

import bubblesim

from .experiment import Experiment, Tolerance, product_of
from .mechanics import crossings, recorded
from .scene import GRAVITY, Body, Joint, Model, Scene, box, box_inertia, cylinder_inertia, sphere


def terminal_theory(linear: float, quadratic: float) -> float:
    """The speed at which the drag d v + q v^2 carries the weight: m g = d v + q v^2, here with m = 2 kg."""
    weight = 2.0 * GRAVITY
    if quadratic == 0:
        return weight / linear
    return (-linear + math.sqrt(linear**2 + 4 * quadratic * weight)) / (2 * quadratic)


def terminal(engine: Any, linear: float, quadratic: float) -> float:
    """Return the speed after 20 s of fall."""
    world = engine(Scene((sphere("ball", 0.1, (0, 0, 0), mass=2.0),), ground=False))
    bubblesim.Drag(world.simulation, world.links["ball"].handle, linear=[linear] * 3, quadratic=[quadratic] * 3)
    world.run(20.0)
    return -float(world.velocity("ball")[2])


def coasting_theory(linear: float, quadratic: float) -> float:
    """m dv/dt = -d v - q v^2 gives 5 exp(-d t / m) for q = 0, 5 / (1 + 5 q t / m) for d = 0; here t = 2 s, m = 2 kg."""
    return 5 * math.exp(-linear) if quadratic == 0 else 5 / (1 + 5 * quadratic)


def coasting(engine: Any, linear: float, quadratic: float) -> float:
    """Return the speed of a body that starts at 5 m/s, after 2 s."""
    world = engine(Scene((sphere("ball", 0.1, (0, 0, 0), mass=2.0),), gravity=(0, 0, 0), ground=False))
    bubblesim.Drag(world.simulation, world.links["ball"].handle, linear=[linear] * 3, quadratic=[quadratic] * 3)
    world.set_velocity("ball", (5, 0, 0))  # along an axis: drag acts on each component by itself
    world.run(2.0)
    return float(world.velocity("ball")[0])


RAFT, DENSITY = (1.0, 0.8, 0.4), 1000.0  # m, kg/m^3


def raft(engine: Any, mass: float, drag: float, depth: float) -> Any:
    """Return a world with a raft whose underside is `depth` below the surface z = 0 of a lake."""
    world = engine(Scene((box("raft", RAFT, (0, 0, RAFT[2] / 2 - depth), mass=mass),), ground=False))
    bubblesim.Buoyancy(world.simulation, DENSITY, layers=[(0.0, 0.0)])
    if drag:
        bubblesim.Drag(world.simulation, world.links["raft"].handle, linear=[drag] * 3)
    return world


def draught_theory(mass: float) -> float:
    """The displaced water weighs as much as the raft: m = rho A d (Archimedes)."""
    return mass / (DENSITY * RAFT[0] * RAFT[1])


def draught(engine: Any, mass: float) -> float:
    """Return the depth of the underside after 20 s."""
    world = raft(engine, mass, 2.0 * mass, 0.3)
    world.run(20.0)
    return RAFT[2] / 2 - float(world.position("raft")[2])


def heaving_theory(mass: float) -> float:
    """T = 2 pi sqrt(m / (rho g A)): a spring of the stiffness rho g A, without added mass."""
    return 2 * math.pi * math.sqrt(mass / (DENSITY * GRAVITY * RAFT[0] * RAFT[1]))


def heaving(engine: Any, mass: float) -> float:
    """Return the mean period of a raft that was pushed down by 5 cm."""
    world = raft(engine, mass, 0.0, draught_theory(mass) + 0.05)
    times, rates = recorded(world, 10.0, 0.005, lambda: world.velocity("raft")[2])
    turns = crossings(times, rates)
    return 2 * (turns[-1] - turns[0]) / (len(turns) - 1)


THRUST, LEVER = 1e-5, 0.02  # N s^2, m


def rotor_theory(quantity: str) -> float:
    """A propeller pushes with k w^2 and turns its mount with the lever times that; here at 500 rad/s."""
    force = THRUST * 500**2
    return force / 0.5 - GRAVITY if quantity == "climb" else force * LEVER


def rotor(engine: Any, quantity: str) -> float:
    """Return the acceleration of a free mount of 0.5 kg with two opposite propellers, or the torque of one on it."""
    names = ("left", "right") if quantity == "climb" else ("left",)
    bodies = [Body("mount", 0.48, box_inertia(0.48, (0.4, 0.1, 0.05)))]
    bodies += [
        Body(name, 0.02 / len(names), cylinder_inertia(0.01, 0.1, 0.01), position=(x, 0.0, 0.1))
        for name, x in zip(names, (-0.2, 0.2) if len(names) == 2 else (0.0,), strict=True)
    ]
    joints = tuple(
        Joint(f"{name}_shaft", "revolute", "mount", name, anchor=body.position)
        for name, body in zip(names, bodies[1:], strict=True)
    )
    world = engine(Scene((Model("copter", tuple(bodies), joints, (0, 0, 5)),), step=0.001, ground=False))
    rotors = [
        bubblesim.Rotor(
            world.simulation,
            world.joints[joint.name].handle,
            clockwise=name == "right",
            thrust_coefficient=THRUST / len(names),
            torque_length=LEVER,
            drag_coefficient=0.0,
            rolling_coefficient=0.0,
        )
        for name, joint in zip(names, joints, strict=True)
    ]
    for propeller in rotors:
        propeller.set_speed(500.0)
    world.run(0.5)
    climb, spin = float(world.velocity("mount")[2]), float(world.spin("mount")[2])
    world.run(0.5)
    if quantity == "climb":
        return (float(world.velocity("mount")[2]) - climb) / 0.5
    return abs(float(world.spin("mount")[2]) - spin) / 0.5 * bodies[0].inertia[2]


EXPERIMENTS = [
    Experiment(
        "terminal_velocity",
        "Falling with drag, terminal velocity",
        "m/s",
        terminal_theory,
        terminal,
        Tolerance("the approach of 20 s", relative=1e-3),
        ({"linear": 3.0, "quadratic": 0.0}, {"linear": 0.0, "quadratic": 0.5}, {"linear": 1.0, "quadratic": 0.2}),
        peers=(),
    ),
    Experiment(
        "coasting",
        "Coasting with drag, speed after 2 s",
        "m/s",
        coasting_theory,
        coasting,
        Tolerance("a drag of the first order in dt: d dt / 2 m", relative=0.01),
        ({"linear": 1.0, "quadratic": 0.0}, {"linear": 0.0, "quadratic": 0.5}),
        peers=(),
    ),
    Experiment(
        "draught",
        "Floating raft, draught",
        "m",
        draught_theory,
        draught,
        Tolerance("the rest of the damped motion", absolute=1e-4),
        product_of(mass=(80.0, 240.0)),
        peers=(),
    ),
    Experiment(
        "heaving",
        "Floating raft, period of heaving",
        "s",
        heaving_theory,
        heaving,
        Tolerance("(w dt)^2 / 24 of the integrator, and the sampling", relative=0.005),
        product_of(mass=(80.0, 240.0)),
        peers=(),
    ),
    Experiment(
        "rotor",
        "Propellers, acceleration of the climb and reaction torque",
        "m/s^2, N m",
        rotor_theory,
        rotor,
        Tolerance("the spin of the propellers themselves", relative=0.01),
        product_of(quantity=("climb", "torque")),
        peers=(),
    ),
]
