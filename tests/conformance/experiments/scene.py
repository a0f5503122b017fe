# SPDX-License-Identifier: BSD-3-Clause
"""What an experiment simulates, in terms that bubblesim, MuJoCo and PyBullet share. SI units, quaternions x, y, z, w.

The friction of two bodies is the lower coefficient; restitution is the body's own.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass

Vector = tuple[float, float, float]
Quaternion = tuple[float, float, float, float]

ZERO: Vector = (0.0, 0.0, 0.0)
UPRIGHT: Quaternion = (0.0, 0.0, 0.0, 1.0)
ALONG_Y: Quaternion = (math.sqrt(0.5), 0.0, 0.0, math.sqrt(0.5))  # turns a shape's z axis to -y: wheels
GRAVITY = 9.81  # m/s^2


def tilted(slope: float, heading: float) -> Vector:
    """Return the gravity in the frame of a plane that falls by `slope` in the direction `heading`, degrees."""
    s, turn = math.radians(slope), math.radians(heading)
    down = GRAVITY * math.sin(s)
    return (down * math.cos(turn), down * math.sin(turn), -GRAVITY * math.cos(s))


def turned(axis: Vector, angle: float) -> Quaternion:
    """Return the rotation about a unit vector."""
    s = math.sin(angle / 2)
    return (axis[0] * s, axis[1] * s, axis[2] * s, math.cos(angle / 2))


def product(a: Quaternion, b: Quaternion) -> Quaternion:
    """Return the rotation b followed by a."""
    ax, ay, az, aw = a
    bx, by, bz, bw = b
    return (
        aw * bx + ax * bw + ay * bz - az * by,
        aw * by - ax * bz + ay * bw + az * bx,
        aw * bz + ax * by - ay * bx + az * bw,
        aw * bw - ax * bx - ay * by - az * bz,
    )


def rotated(q: Quaternion, v: Vector) -> Vector:
    """Return the vector after the rotation."""
    x, y, z, _ = product(product(q, (*v, 0.0)), (-q[0], -q[1], -q[2], q[3]))
    return (x, y, z)


@dataclass(frozen=True)
class Shape:
    """A collision shape in its body's frame."""

    kind: str  # box, sphere, cylinder (along z) or mesh
    size: tuple[float, ...]  # m. box: x, y, z; sphere: radius; cylinder: radius, length; mesh: x, y, z of a cuboid
    position: Vector = ZERO
    orientation: Quaternion = UPRIGHT


@dataclass(frozen=True)
class Body:
    """A rigid body; its origin is its centre of mass, its axes are its principal axes."""

    name: str
    mass: float  # kg
    inertia: Vector  # kg m^2, about its axes
    shapes: tuple[Shape, ...] = ()
    position: Vector = ZERO  # in the model's frame, with the model's axes
    mu: float = 1.0  # Coulomb friction
    bounce: float = 0.0  # restitution
    sensors: str = ""  # SDFormat, for bubblesim only
    torsional: str = ""  # SDFormat in <friction>, for bubblesim only
    rolling: float = 0.0  # m, resistance to rolling; for bubblesim and MuJoCo


@dataclass(frozen=True)
class Joint:
    """A joint of two bodies of a model. Its position is 0 at the start."""

    name: str
    kind: str  # revolute, prismatic or fixed
    parent: str  # name of a body, or world
    child: str
    axis: Vector = (0.0, 0.0, 1.0)  # in the model's frame
    anchor: Vector = ZERO  # in the model's frame
    motor: str = ""  # velocity or effort; "" is a free axis
    effort: float = 1e9  # limit of the motor, N m or N
    lower: float = -math.inf  # rad or m
    upper: float = math.inf
    sensors: str = ""  # SDFormat, for bubblesim only


@dataclass(frozen=True)
class Model:
    """Bodies and the joints between them, which form a tree. The first body is the root, unless `world` holds it."""

    name: str
    bodies: tuple[Body, ...]
    joints: tuple[Joint, ...] = ()
    position: Vector = ZERO
    orientation: Quaternion = UPRIGHT
    static: bool = False

    def body(self, name: str) -> Body:
        """Return the body of this name."""
        return next(body for body in self.bodies if body.name == name)

    def fixed_to_world(self) -> bool:
        """Return whether a joint holds the model."""
        return any(joint.parent == "world" for joint in self.joints)

    def place(self, body: Body) -> Vector:
        """Return the body's position in the world at the start."""
        x, y, z = rotated(self.orientation, body.position)
        return (self.position[0] + x, self.position[1] + y, self.position[2] + z)


@dataclass(frozen=True)
class Scene:
    """Models on a plane."""

    models: tuple[Model, ...]
    step: float = 0.005  # s, physics substep
    substeps: int = 1  # of a simulation step: how often bubblesim measures
    gravity: Vector = (0.0, 0.0, -GRAVITY)
    ground: bool = True  # the plane z = 0
    world: str = ""  # SDFormat, for bubblesim only
    physics: str = ""  # SDFormat in <physics>, for bubblesim only

    def bodies(self) -> Iterator[tuple[Model, Body]]:
        """Return all bodies with their models."""
        return ((model, body) for model in self.models for body in model.bodies)


def box_inertia(mass: float, size: Vector) -> Vector:
    """Return the moments of inertia of a homogeneous cuboid."""
    x, y, z = (s * s for s in size)
    return (mass * (y + z) / 12, mass * (x + z) / 12, mass * (x + y) / 12)


def sphere_inertia(mass: float, radius: float) -> Vector:
    """Return the moments of inertia of a homogeneous sphere."""
    return (0.4 * mass * radius**2,) * 3


def cylinder_inertia(mass: float, radius: float, length: float, axis: int = 2) -> Vector:
    """Return the moments of inertia of a homogeneous cylinder along an axis (0, 1, 2)."""
    across = mass * (3 * radius**2 + length**2) / 12
    moments = [across, across, across]
    moments[axis] = mass * radius**2 / 2
    return (moments[0], moments[1], moments[2])


def box(
    name: str,
    size: Vector,
    position: Vector,
    *,
    mass: float = 1.0,
    orientation: Quaternion = UPRIGHT,
    mu: float = 1.0,
    bounce: float = 0.0,
    static: bool = False,
    mesh: bool = False,
) -> Model:
    """Return a free cuboid."""
    shape = Shape("mesh" if mesh else "box", size)
    body = Body(name, mass, box_inertia(mass, size), (shape,), mu=mu, bounce=bounce)
    return Model(name, (body,), position=position, orientation=orientation, static=static)


def sphere(
    name: str, radius: float, position: Vector, *, mass: float = 1.0, mu: float = 1.0, bounce: float = 0.0
) -> Model:
    """Return a free sphere."""
    body = Body(name, mass, sphere_inertia(mass, radius), (Shape("sphere", (radius,)),), mu=mu, bounce=bounce)
    return Model(name, (body,), position=position)


def roller(shape: str, heading: float, *, mu: float = 1.0, rolling: float = 0.0, jointed: bool = False) -> Model:
    """Return a ball or a cylinder of 1 kg and 0.1 m that rolls towards a heading, degrees; a joint makes it a robot."""
    form, inertia = Shape("sphere", (0.1,)), sphere_inertia(1.0, 0.1)
    if shape == "cylinder":
        form = Shape("cylinder", (0.1, 0.3), orientation=turned((1, 0, 0), math.pi / 2))
        inertia = cylinder_inertia(1.0, 0.1, 0.3, axis=1)
    bodies = [Body("body", 1.0, inertia, (form,), mu=mu, rolling=rolling)]
    joints = []
    if jointed:
        bodies.append(Body("core", 1e-4, (1e-8, 1e-8, 1e-8)))
        joints.append(Joint("fixed", "fixed", "body", "core"))
    facing = turned((0, 0, 1), math.radians(heading))
    return Model("body", tuple(bodies), tuple(joints), position=(0, 0, 0.1), orientation=facing)
