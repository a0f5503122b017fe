# SPDX-License-Identifier: BSD-3-Clause
"""A scene in PyBullet, with its default solver of 50 iterations and without its default damping."""

from __future__ import annotations

import math
import tempfile
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np

from .scene import Joint, Model, Scene, Shape, Vector


def numbers(*values: float) -> str:
    """Return an attribute of several numbers."""
    return " ".join(repr(float(value)) for value in values)


def rpy(q: tuple[float, float, float, float]) -> Vector:
    """Return roll, pitch and yaw."""
    x, y, z, w = q
    return (
        math.atan2(2 * (w * x + y * z), 1 - 2 * (x * x + y * y)),
        math.asin(max(-1.0, min(1.0, 2 * (w * y - z * x)))),
        math.atan2(2 * (w * z + x * y), 1 - 2 * (y * y + z * z)),
    )


def collision_text(shape: Shape, offset: Vector) -> str:
    """Return a collision; `offset` is the body's origin in the frame of its URDF link."""
    place = numbers(*(a + b for a, b in zip(shape.position, offset, strict=True)))
    if shape.kind in ("box", "mesh"):
        inside = f'<box size="{numbers(*shape.size)}"/>'
    elif shape.kind == "sphere":
        inside = f'<sphere radius="{shape.size[0]}"/>'
    else:
        inside = f'<cylinder radius="{shape.size[0]}" length="{shape.size[1]}"/>'
    turn = numbers(*rpy(shape.orientation))
    return f'<collision><origin xyz="{place}" rpy="{turn}"/><geometry>{inside}</geometry></collision>'


def urdf(model: Model) -> str:
    """Return the URDF of a model. The frame of a link is its joint's, that of the root its centre of mass."""
    joints = {joint.child: joint for joint in model.joints}

    def origin(name: str) -> Vector:
        if name == "world":
            return (0.0, 0.0, 0.0)
        return joints[name].anchor if name in joints else model.body(name).position

    text = '<link name="world"/>' if model.fixed_to_world() else ""
    for body in model.bodies:
        offset = tuple(p - o for p, o in zip(body.position, origin(body.name), strict=True))
        ixx, iyy, izz = body.inertia
        mass = 0.0 if model.static else body.mass
        text += f"""<link name="{body.name}"><inertial><origin xyz="{numbers(*offset)}"/><mass value="{mass!r}"/>
            <inertia ixx="{ixx!r}" iyy="{iyy!r}" izz="{izz!r}" ixy="0" ixz="0" iyz="0"/></inertial>
            {"".join(collision_text(shape, offset) for shape in body.shapes)}</link>"""
    for joint in model.joints:
        place = tuple(a - o for a, o in zip(joint.anchor, origin(joint.parent), strict=True))
        text += joint_text(joint, place)
    return f'<robot name="{model.name}">{text}</robot>'


def joint_text(joint: Joint, place: Vector) -> str:
    """Return a joint of a URDF."""
    limited = math.isfinite(joint.lower) or math.isfinite(joint.upper)
    kind = "continuous" if joint.kind == "revolute" and not limited else joint.kind
    lower, upper = (max(joint.lower, -1e3), min(joint.upper, 1e3)) if limited else (1, -1)
    return f"""<joint name="{joint.name}" type="{kind}"><origin xyz="{numbers(*place)}"/><parent link="{joint.parent}"/>
        <child link="{joint.child}"/><axis xyz="{numbers(*joint.axis)}"/>
        <limit lower="{lower}" upper="{upper}" effort="1e9" velocity="1e9"/><dynamics damping="0"/></joint>"""


class PyBullet:
    """A scene that PyBullet runs."""

    name = "PyBullet"

    def __init__(self, scene: Scene) -> None:
        """Build the models."""
        import pybullet

        self.api: Any = pybullet
        self.scene = scene
        self.time = 0.0
        self.of = {"physicsClientId": pybullet.connect(pybullet.DIRECT)}
        pybullet.setPhysicsEngineParameter(fixedTimeStep=scene.step, numSolverIterations=50, **self.of)
        pybullet.setGravity(*scene.gravity, **self.of)
        alike = {body.mu for model, body in scene.bodies() if not model.static}
        self.same_mu = alike.pop() if len(alike) == 1 else None
        if scene.ground:
            plane = pybullet.createCollisionShape(pybullet.GEOM_PLANE, **self.of)
            ground = pybullet.createMultiBody(0, plane, **self.of)
            pybullet.changeDynamics(ground, -1, lateralFriction=self.friction(1.0), restitution=1, **self.of)
        self.links: dict[str, tuple[int, int]] = {}
        self.joints: dict[str, tuple[int, int, Joint]] = {}
        with tempfile.TemporaryDirectory() as folder:
            for model in scene.models:
                self.add(model, Path(folder) / f"{model.name}.urdf")

    def __del__(self) -> None:
        """Free the engine's memory."""
        self.api.disconnect(**self.of)

    def friction(self, mu: float) -> float:
        """Return a coefficient such that the product of two is their friction (see `Scene`)."""
        return mu if self.same_mu is None else math.sqrt(self.same_mu)

    def add(self, model: Model, path: Path) -> None:
        """Load a model; joints have no motors yet."""
        api = self.api
        path.write_text(urdf(model))
        held = model.fixed_to_world()
        place = model.position if held else model.place(model.bodies[0])
        flags = api.URDF_USE_INERTIA_FROM_FILE
        index = api.loadURDF(
            str(path), place, model.orientation, useFixedBase=held or model.static, flags=flags, **self.of
        )
        names = {model.bodies[0].name: -1} if not held else {}
        for i in range(api.getNumJoints(index, **self.of)):
            info = api.getJointInfo(index, i, **self.of)
            names[info[12].decode()] = i
            joint = next(j for j in model.joints if j.name == info[1].decode())
            self.joints[joint.name] = (index, i, joint)
            if joint.kind != "fixed":
                api.setJointMotorControl2(index, i, api.VELOCITY_CONTROL, force=0, **self.of)
                if joint.motor == "velocity":
                    self.set_target(joint.name, 0.0)
        for body in model.bodies:
            link = names[body.name]
            self.links[body.name] = (index, link)
            surface = {"lateralFriction": self.friction(body.mu), "restitution": body.bounce}
            api.changeDynamics(index, link, jointDamping=0, **surface, **self.of)
            # A call with these changes the base, whatever the link.
            api.changeDynamics(index, link, linearDamping=0, angularDamping=0, maxJointVelocity=1e6, **self.of)

    def run(self, seconds: float, forces: Mapping[str, Vector] | None = None) -> None:
        """Run for a time; the forces act at the centres of mass meanwhile."""
        steps = round(seconds / self.scene.step)
        self.time += steps * self.scene.step
        for _ in range(steps):
            for body, force in (forces or {}).items():
                self.api.applyExternalForce(
                    *self.links[body], force, self.position(body), self.api.WORLD_FRAME, **self.of
                )
            for index, i, joint in self.joints.values():
                if joint.motor == "effort":
                    effort = self.efforts.get(joint.name, 0.0)
                    self.api.setJointMotorControl2(index, i, self.api.TORQUE_CONTROL, force=effort, **self.of)
            self.api.stepSimulation(**self.of)

    @property
    def efforts(self) -> dict[str, float]:
        """The commanded efforts."""
        return self.__dict__.setdefault("_efforts", {})

    def state(self, body: str) -> tuple[Any, Any, Any, Any]:
        """Return position, orientation, linear and angular velocity of the centre of mass."""
        index, link = self.links[body]
        if link < 0:
            pose = self.api.getBasePositionAndOrientation(index, **self.of)
            return (*pose, *self.api.getBaseVelocity(index, **self.of))
        state = self.api.getLinkState(index, link, computeLinkVelocity=1, computeForwardKinematics=1, **self.of)
        return (state[0], state[1], state[6], state[7])

    def position(self, body: str) -> np.ndarray:
        """Return the centre of mass of a body."""
        return np.array(self.state(body)[0])

    def orientation(self, body: str) -> np.ndarray:
        """Return a quaternion x, y, z, w."""
        return np.array(self.state(body)[1])

    def velocity(self, body: str) -> np.ndarray:
        """Return the velocity of the centre of mass."""
        return np.array(self.state(body)[2])

    def spin(self, body: str) -> np.ndarray:
        """Return the angular velocity, world axes."""
        return np.array(self.state(body)[3])

    def set_velocity(self, body: str, linear: Vector, angular: Vector = (0.0, 0.0, 0.0)) -> None:
        """Set the velocity of a body without joints."""
        self.api.resetBaseVelocity(self.links[body][0], linear, angular, **self.of)

    def set_motion(self, model: Model, linear: Vector, joint_velocities: Mapping[str, float]) -> None:
        """Move a model without turning it, while the children of these joints turn about their own centres."""
        self.set_velocity(model.bodies[0].name, linear)
        for name, rate in joint_velocities.items():
            index, i, _ = self.joints[name]
            self.api.resetJointState(index, i, self.joint_position(name), rate, **self.of)

    def joint_position(self, joint: str) -> float:
        """Return radians or metres."""
        index, i, _ = self.joints[joint]
        return float(self.api.getJointState(index, i, **self.of)[0])

    def joint_velocity(self, joint: str) -> float:
        """Return rad/s or m/s."""
        index, i, _ = self.joints[joint]
        return float(self.api.getJointState(index, i, **self.of)[1])

    def set_target(self, joint: str, value: float) -> None:
        """Command the motor of a joint: its velocity or its effort."""
        index, i, described = self.joints[joint]
        if described.motor == "effort":
            self.efforts[joint] = value
            return
        self.api.setJointMotorControl2(
            index, i, self.api.VELOCITY_CONTROL, targetVelocity=value, force=min(described.effort, 1e6), **self.of
        )
