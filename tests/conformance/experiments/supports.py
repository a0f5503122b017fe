# SPDX-License-Identifier: BSD-3-Clause
"""How supports share the weight of a robot."""

from __future__ import annotations

from typing import Any

import numpy as np

from .experiment import Experiment, Tolerance, product_of
from .scene import ALONG_Y, GRAVITY, Body, Joint, Model, Scene, Shape, box_inertia, sphere_inertia


def castor_robot(mu: float) -> Model:
    """Return two cylinder wheels (track 0.4 m, radius 0.1 m) between two castors without friction, 0.2 m away."""
    sensor = '<sensor name="{}_load" type="contact"><always_on>1</always_on></sensor>'
    wheels = [
        Body(
            side,
            1.0,
            (0.003, 0.005, 0.003),
            (Shape("cylinder", (0.1, 0.02), orientation=ALONG_Y),),
            position=(0, y, -0.05),
            mu=mu,
            sensors=sensor.format(side),
        )
        for side, y in (("left", 0.2), ("right", -0.2))
    ]
    castors = [
        Body(name, 0.5, sphere_inertia(0.5, 0.05), (Shape("sphere", (0.05,)),), position=(x, 0, -0.1), mu=0.0)
        for name, x in (("fore", 0.2), ("aft", -0.2))
    ]
    joints = [
        Joint(f"{w.name}_axle", "revolute", "base", w.name, (0, 1, 0), w.position, motor="velocity", effort=20)
        for w in wheels
    ]
    joints += [Joint(f"{c.name}_mount", "fixed", "base", c.name, anchor=c.position) for c in castors]
    base = Body("base", 10.0, box_inertia(10.0, (0.4, 0.3, 0.1)))
    return Model("robot", (base, *wheels, *castors), tuple(joints), (0, 0, 0.15))


def castors_theory(mu: float, step: float) -> float:
    """w = 2 u / t: castors without friction do not resist; the wheels turn at u = 0.5 m/s, the track t is 0.4 m."""
    return 2.5


def spinning_robot(engine: Any, mu: float, step: float) -> Any:
    """Return the robot, turning in place for a second."""
    world = engine(Scene((castor_robot(mu),), step=step))
    world.set_target("left_axle", -5.0)
    world.set_target("right_axle", 5.0)
    world.run(1.0)
    return world


def castors(engine: Any, mu: float, step: float) -> float:
    """Return the spin of the robot."""
    world = spinning_robot(engine, mu, step)
    rates = []
    for _ in range(10):
        world.run(0.1)
        rates.append(world.spin("base")[2])
    return float(np.mean(rates))


def load_theory(mu: float, step: float) -> float:
    """Four supports under a symmetric load are undetermined for rigid bodies; equal springs carry a half by the wheels.

    A spring for each contact point instead (two under a cylinder) makes it two thirds.
    """
    return 0.5


def wheel_load(engine: Any, mu: float, step: float) -> float:
    """Return the share of the weight on the wheels."""
    world = spinning_robot(engine, mu, step)
    shares = []
    for _ in range(20):
        world.run(0.05)
        force = 0.0
        for side in ("left", "right"):
            reading = world.simulation.object(f"/robot/{side}/{side}_load").reading
            force += sum(contact.force[2] for contact in reading.contacts)
        shares.append(force / (13 * GRAVITY))
    return float(np.mean(shares))


def lever_theory(ahead: float) -> float:
    """The lever rule: with the centre of mass d ahead of the axle and a castor at L, the wheels carry 1 - d / L."""
    return 1 - ahead / 0.4


def lever(engine: Any, ahead: float) -> float:
    """Return the share of the weight on two wheels; the wheels and the castor weigh next to nothing."""
    sensor = '<sensor name="{}_load" type="contact"/>'
    parts = [
        Body(
            name,
            1e-3,
            sphere_inertia(1e-3, 0.1),
            (Shape("sphere", (0.1,)),),
            position=place,
            mu=mu,
            sensors=sensor.format(name),
        )
        for name, place, mu in (
            ("left", (-ahead, 0.2, -0.05), 0.8),
            ("right", (-ahead, -0.2, -0.05), 0.8),
            ("castor", (0.4 - ahead, 0.0, -0.05), 0.0),
        )
    ]
    joints = tuple(
        Joint(f"{p.name}_axle", "revolute", "base", p.name, (0, 1, 0), p.position, motor="velocity", effort=20)
        for p in parts
    )
    base = Body("base", 10.0, box_inertia(10.0, (0.4, 0.3, 0.1)))
    world = engine(Scene((Model("robot", (base, *parts), joints, (0, 0, 0.15)),)))
    world.run(1.0)
    loads = {p.name: 0.0 for p in parts}
    for name in loads:
        for contact in world.simulation.object(f"/{name}_load").reading.contacts:
            loads[name] += float(contact.force[2])
    return (loads["left"] + loads["right"]) / sum(loads.values())


EXPERIMENTS = [
    Experiment(
        "castors",
        "Two castors and two wheels, spin, mu 0.5 to 1, 0.5 to 5 ms",
        "rad/s",
        castors_theory,
        castors,
        Tolerance("a cylinder may roll on either of its edges: w / t = 5 %, and slip", relative=0.12),
        product_of(mu=(0.5, 0.75, 1.0), step=(0.0005, 0.001, 0.002, 0.005)),
    ),
    Experiment(
        "wheel_load",
        "Two castors and two wheels, share of the wheels",
        "",
        load_theory,
        wheel_load,
        Tolerance("undetermined for rigid bodies: each pair of supports carries at least 5 %", absolute=0.45),
        product_of(mu=(0.5, 1.0), step=(0.001, 0.005)),
        peers=(),
    ),
    Experiment(
        "lever",
        "Centre of mass ahead of the axle, share of the wheels",
        "",
        lever_theory,
        lever,
        Tolerance("the lever changes by the overlap of the contacts", absolute=0.005),
        product_of(ahead=(0.02, 0.1, 0.2)),
        peers=(),
    ),
]
