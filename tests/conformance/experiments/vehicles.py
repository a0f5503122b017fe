# SPDX-License-Identifier: BSD-3-Clause
"""Vehicles whose motion depends on the loads of their wheels."""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from .experiment import Experiment, Tolerance, lowest, product_of
from .scene import ALONG_Y, GRAVITY, Body, Joint, Model, Scene, Shape, box, box_inertia, sphere_inertia, tilted, turned


def cart(
    height: float,
    *,
    mass: float = 10.0,
    base: float = 0.6,
    track: float = 0.4,
    mu: float = 0.5,
    heading: float = 0.0,
    locked: str = "front rear left right",
    motor: str = "velocity",
    torque: float = 5.0,
) -> Model:
    """Return four spheres of 0.1 m under a chassis whose centre of mass is at `height`; heading in degrees."""
    wheels, joints = [], []
    for along, x in (("front", base / 2), ("rear", -base / 2)):
        for side, y in (("left", track / 2), ("right", -track / 2)):
            name = f"{along}_{side}"
            place = (x, y, 0.1 - height)
            shape = (Shape("sphere", (0.1,)),)
            wheels.append(Body(name, 1.0, sphere_inertia(1.0, 0.1), shape, position=place, mu=mu))
            held = along in locked.split() or side in locked.split()
            joints.append(
                Joint(f"{name}_axle", "revolute", "chassis", name, (0, 1, 0), place, motor if held else "", torque)
            )
    chassis = Body("chassis", mass, box_inertia(mass, (base, track, 0.1)))
    turn = turned((0, 0, 1), math.radians(heading))
    return Model("cart", (chassis, *wheels), tuple(joints), (0, 0, height), turn)


def driven(engine: Any, model: Model, speed: float, step: float = 0.005) -> Any:
    """Return a world in which a cart moves along its heading; its free wheels roll."""
    world = engine(Scene((model,), step=step))
    world.run(0.1)
    direction = np.array([1 - 2 * model.orientation[2] ** 2, 2 * model.orientation[2] * model.orientation[3], 0])
    rolling = {joint.name: speed / 0.1 for joint in model.joints if not joint.motor}
    world.set_motion(model, tuple(float(x) for x in speed * direction), rolling)
    return world


def stopping_theory(heading: float) -> float:
    """s = v^2 / (2 mu g) (Coulomb), here with 2 m/s and mu = 0.5."""
    return 2**2 / (2 * 0.5 * GRAVITY)


def stopping(engine: Any, heading: float) -> float:
    """Return the way of a cart with locked wheels until it stops."""
    world = driven(engine, cart(0.2, heading=heading), 2.0)
    start = world.position("chassis")
    world.run(2.0)
    return float(np.linalg.norm((world.position("chassis") - start)[:2]))


WHEEL, WHEELS, CHASSIS, RADIUS, BASE = 1.0, 4, 10.0, 0.1, 0.6  # kg, count, kg, m, m


def brake_height(ratio: float) -> float:
    """Return the height of the chassis that puts the common centre of mass at `ratio` of the wheel base."""
    return (ratio * BASE * (CHASSIS + WHEELS * WHEEL) - WHEELS * WHEEL * RADIUS) / CHASSIS


def brake_loads(wheels: str, mu: float, ratio: float) -> tuple[float, float, float]:
    """Return the deceleration and the loads of the leading and of the trailing axle: see braking_theory()."""
    total = CHASSIS + WHEELS * WHEEL
    inertia = 2 * 0.4 * WHEEL * RADIUS**2
    front, rear = (mu, 0.0) if wheels == "front" else (0.0, mu)
    matrix = [
        [total + inertia / RADIUS**2, -front, -rear],
        [0, 1, 1],
        [ratio * BASE * total + inertia / RADIUS, -BASE / 2, BASE / 2],
    ]
    deceleration, leading, trailing = np.linalg.solve(matrix, [0, total * GRAVITY, 0])
    return float(deceleration), float(leading), float(trailing)


def braking_theory(wheels: str, heading: float) -> float:
    """Three linear equations for the deceleration a and the loads F, R of the axles, with h / L = 0.6 and mu = 0.5.

    m a = mu B - I a / r^2, F + R = m g, (R - F) L / 2 + h m a = -I a / r. B is the load of the braked axle, I the
    inertia of the two free wheels, whose spin slows down with the cart. With I = 0 this is the textbook's
    mu g (L / 2) / (L +- mu h) (Gillespie, Fundamentals of Vehicle Dynamics, chapter 3).
    """
    return brake_loads(wheels, 0.5, 0.6)[0]


def decelerate(engine: Any, model: Model, speed: float, step: float = 0.005) -> float:
    """Return the deceleration of a cart while it brakes, from 0.15 to 0.4 s."""
    world = driven(engine, model, speed, step)
    world.run(0.15)
    before = np.linalg.norm(world.velocity("chassis")[:2])
    world.run(0.25)
    return float(before - np.linalg.norm(world.velocity("chassis")[:2])) / 0.25


def braking(engine: Any, wheels: str, heading: float) -> float:
    """Return the deceleration of a cart with one locked axle."""
    return decelerate(engine, cart(brake_height(0.6), heading=heading, locked=wheels), 2.0)


def load_transfer_theory(wheels: str, way: str, mu: float, ratio: float) -> float:
    """The equations of braking_theory() with any mu and h / L.

    `wheels` are those that brake, "front" being the axle that leads. The other axle must keep a load.
    """
    return brake_loads(wheels, mu, ratio)[0]


def load_transfer(engine: Any, wheels: str, way: str, mu: float, ratio: float) -> float:
    """Return the deceleration of a cart that drives forward or backward."""
    sign = 1.0 if way == "forward" else -1.0
    locked = wheels if way == "forward" else {"front": "rear", "rear": "front"}[wheels]
    model = cart(brake_height(ratio), mu=mu, locked=locked, torque=50.0)
    speed = 2 + 0.4 * load_transfer_theory(wheels, way, mu, ratio)
    return decelerate(engine, model, sign * speed)


def load_transfer_cases() -> tuple[dict[str, Any], ...]:
    """Return the combinations in which the axle that does not brake keeps a tenth of the weight at least."""
    cases = product_of(
        wheels=("rear", "front"), way=("forward", "backward"), mu=(0.3, 0.6, 1.0, 1.5), ratio=(0.3, 0.45, 0.56, 0.7)
    )
    weight = GRAVITY * (CHASSIS + WHEELS * WHEEL)

    def stands(case: dict[str, Any]) -> bool:
        loads = brake_loads(case["wheels"], case["mu"], case["ratio"])[1:]
        return bool(min(loads) > 0.1 * weight)

    return tuple(dict(case) for case in cases if stands(dict(case)))


def spot_rate(base: float, track: float, speed: float = 0.5) -> float:
    """Return the yaw rate at which the friction of four equally loaded wheels has no torque about the centre."""
    points = [(x, y) for x in (base / 2, -base / 2) for y in (track / 2, -track / 2)]

    def torque(rate: float) -> float:
        total = 0.0
        for x, y in points:
            drive = speed if y < 0 else -speed
            slip = (-rate * y - drive, rate * x)
            size = math.hypot(*slip)
            total += (y * slip[0] - x * slip[1]) / size if size > 0 else 0.0
        return total

    return lowest(lambda rate: torque(rate) <= 0, 0.0, 2 * speed / track, 1e-9)


def skid_steer_theory(base: float, track: float) -> float:
    """The yaw rate without net torque of Coulomb's forces -mu N slip / |slip|, found by bisection (`spot_rate`).

    For four equal loads it is 2 t u / (t^2 + b^2), with the speed u of the wheels, the track t and the base b.
    """
    return spot_rate(base, track)


def skid_steer(engine: Any, base: float, track: float) -> float:
    """Return the yaw rate of a cart that turns in place."""
    world = engine(Scene((cart(0.15, base=base, track=track, mu=0.8),)))
    for along in ("front", "rear"):
        world.set_target(f"{along}_left_axle", -5.0)
        world.set_target(f"{along}_right_axle", 5.0)
    world.run(2.0)
    rates = []
    for _ in range(20):
        world.run(0.1)
        rates.append(world.spin("chassis")[2])
    return float(np.mean(rates))


def kerb_theory(shape: str, height: float) -> float:
    """tan(a) with cos(a) = 1 - h / r: the kerb's edge alone carries a wheel that leaves the floor (statics).

    At less friction, the wheel spins at both contacts. It is driven so slowly that its motion does not help it.
    """
    return math.tan(math.acos(1 - height))


def kerb(engine: Any, shape: str, height: float) -> float:
    """Return the least friction with which a driven wheel climbs a kerb, whose height is that part of the radius."""
    radius, mass = 0.1, 5.0
    form = Shape("sphere", (radius,)) if shape == "sphere" else Shape("cylinder", (radius, 0.04), orientation=ALONG_Y)
    start = radius * math.sqrt(1 - (1 - height) ** 2) + 0.005  # 5 mm before the kerb

    def climbs(mu: float) -> bool:
        wheel = Body("wheel", mass, sphere_inertia(mass, radius), (form,), mu=mu)
        bodies = (Body("along", 0.01, (1e-5,) * 3), Body("up", 0.01, (1e-5,) * 3), wheel)
        joints = (
            Joint("way", "prismatic", "world", "along", (1, 0, 0)),
            Joint("height", "prismatic", "along", "up", (0, 0, 1)),
            Joint("axle", "revolute", "up", "wheel", (0, 1, 0), motor="velocity", effort=20.0),
        )
        step = height * radius
        block = box("kerb", (1.0, 1.0, step), (start + 0.5, 0, step / 2), mu=mu, static=True)
        world = engine(Scene((Model("wheel", bodies, joints, (0, 0, radius)), block)))
        world.set_target("axle", 0.1)
        world.run(14.0)
        return bool(world.position("wheel")[2] > radius + 0.9 * step)

    theory = kerb_theory(shape, height)
    return lowest(climbs, 0.5 * theory, 1.5 * theory, 0.01 * theory)


def across_theory(driven: bool) -> float:
    """Wheels that do not slip keep to their line: static friction takes the load, however long (Coulomb)."""
    return 0.0


def across(engine: Any, driven: bool) -> float:
    """Let a cart stand, or drive 2 m, across a slope of 10 degrees; return by how far it has come down in 10 s."""
    world = engine(Scene((cart(0.15, mu=1.0),), gravity=tilted(10, 90)))
    world.run(0.2)
    start = world.position("chassis")
    for along in ("front", "rear") if driven else ():
        for side in ("left", "right"):
            world.set_target(f"{along}_{side}_axle", 2.0)
    world.run(10.0)
    return float(world.position("chassis")[1] - start[1])


def car(radius: float, mu: float) -> Model:
    """Return a cart whose free wheels roll on circles about one point, beside its rear axle (Ackermann)."""
    bodies, joints = [Body("chassis", CHASSIS, box_inertia(CHASSIS, (BASE, 0.4, 0.1)))], []
    for along, x in (("front", BASE / 2), ("rear", -BASE / 2)):
        for side, y in (("left", 0.2), ("right", -0.2)):
            name, place = f"{along}_{side}", (x, y, RADIUS - 0.15)
            bodies.append(Body(name, 0.1, sphere_inertia(0.1, RADIUS), (Shape("sphere", (RADIUS,)),), place, mu))
            turn = math.atan2(BASE / 2 + x, radius - y)
            axis = (-math.sin(turn), math.cos(turn), 0.0)
            joints.append(Joint(f"{name}_axle", "revolute", "chassis", name, axis, place))
    return Model("car", tuple(bodies), tuple(joints), (0, 0, 0.15))


def curve_theory(radius: float, mu: float) -> float:
    """v^2 = mu g R (Coulomb), with R from the centre of the circle to the centre of mass."""
    return math.sqrt(mu * GRAVITY * math.hypot(radius, BASE / 2))


def curve(engine: Any, radius: float, mu: float) -> float:
    """Push a car on a circle ever faster, by 0.1 m/s^2; return its speed when it has left the circle by 0.3 %."""
    world = engine(Scene((car(radius, mu),)))
    world.run(0.2)
    centre, way = np.array([-BASE / 2, radius]), math.hypot(radius, BASE / 2)
    while world.time < 60:
        from_centre = world.position("chassis")[:2] - centre
        distance = float(np.linalg.norm(from_centre))
        if distance > 1.003 * way:
            break
        along = np.array([-from_centre[1], from_centre[0]]) / distance * 0.1 * (CHASSIS + 0.4)
        world.run(0.02, {"chassis": (float(along[0]), float(along[1]), 0.0)})
    return float(np.linalg.norm(world.velocity("chassis")[:2]))


EXPERIMENTS = [
    Experiment(
        "stopping",
        "Locked wheels from 2 m/s in any direction, mu 0.5, distance",
        "m",
        stopping_theory,
        stopping,
        Tolerance("semi-implicit Euler is v dt / 2 = 5 mm short", relative=0.02),
        product_of(heading=(0.0, 30.0, 45.0, 80.0)),
    ),
    Experiment(
        "braking",
        "Braking by one axle, mu 0.5, h/L 0.6, deceleration",
        "m/s^2",
        braking_theory,
        braking,
        Tolerance("the cart pitches by up to 1 mm of contact depth", relative=0.03),
        product_of(wheels=("rear", "front"), heading=(0.0, 45.0)),
    ),
    Experiment(
        "load_transfer",
        "Braking by one axle, forward and backward, mu 0.3 to 1.5, h/L 0.3 to 0.7, deceleration",
        "m/s^2",
        load_transfer_theory,
        load_transfer,
        Tolerance("the cart pitches by up to 1 mm of contact depth", relative=0.01),
        load_transfer_cases(),
    ),
    Experiment(
        "skid_steer",
        "Skid steering in place, three ratios of base and track, yaw rate",
        "rad/s",
        skid_steer_theory,
        skid_steer,
        Tolerance("wheel loads vary while turning", relative=0.15),
        ({"base": 0.5, "track": 0.4}, {"base": 0.4, "track": 0.4}, {"base": 0.3, "track": 0.4}),
    ),
    Experiment(
        "kerb",
        "Driven wheel before a kerb of 0.3 and 0.5 radii, least friction",
        "",
        kerb_theory,
        kerb,
        Tolerance("bisection to 1 %; an overlap of up to 1 mm makes the kerb lower by as much", relative=0.03),
        product_of(shape=("sphere", "cylinder"), height=(0.3, 0.5)),
    ),
    Experiment(
        "across",
        "Cart across a slope of 10 degrees, way down in 10 s",
        "m",
        across_theory,
        across,
        Tolerance("a quarter of a percent of the way", absolute=0.005),
        product_of(driven=(False, True)),
    ),
    Experiment(
        "curve",
        "Car on a circle, speed at which it slides off",
        "m/s",
        curve_theory,
        curve,
        Tolerance("its speed grows by 2 % until it has left the circle", relative=0.03),
        ({"radius": 2.0, "mu": 0.5}, {"radius": 4.0, "mu": 0.3}),
    ),
]
