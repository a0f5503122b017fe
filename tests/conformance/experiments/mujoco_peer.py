# SPDX-License-Identifier: BSD-3-Clause
"""A scene in MuJoCo, with its defaults except an elliptic friction cone, impratio 10 and an implicit integrator."""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import Any

import numpy as np

from .scene import Body, Joint, Model, Quaternion, Scene, Shape, Vector


def numbers(*values: float) -> str:
    """Return an attribute of several numbers."""
    return " ".join(repr(float(value)) for value in values)


def quaternion(q: Quaternion) -> str:
    """Return MuJoCo's order: w, x, y, z."""
    return numbers(q[3], q[0], q[1], q[2])


def geom_text(shape: Shape, body: Body) -> str:
    """Return a geom. Of two geoms, the one with the lower friction defines it."""
    where = f'pos="{numbers(*shape.position)}" quat="{quaternion(shape.orientation)}"'
    kind = f'condim="{6 if body.rolling else 3}"'
    friction = f'friction="{body.mu} 0 {body.rolling}" priority="{round(1000 * (2 - min(body.mu, 2)))}" {kind}'
    if shape.kind in ("box", "mesh"):
        size = numbers(*(s / 2 for s in shape.size))
    elif shape.kind == "cylinder":
        size = numbers(shape.size[0], shape.size[1] / 2)
    else:
        size = numbers(*shape.size)
    return f'<geom type="{"box" if shape.kind == "mesh" else shape.kind}" size="{size}" {where} {friction} mass="0"/>'


def body_text(model: Model, body: Body) -> str:
    """Return a body with its joint and its children."""
    joint = next((joint for joint in model.joints if joint.child == body.name), None)
    parent = joint.parent if joint else None
    if parent is None or parent == "world":
        place, turn = model.place(body), model.orientation
    else:
        place = tuple(c - p for c, p in zip(body.position, model.body(parent).position, strict=True))
        turn = (0, 0, 0, 1)
    moves = "" if model.static else "<freejoint/>"
    if joint:
        moves = joint_text(joint, body)
    children = "".join(body_text(model, model.body(j.child)) for j in model.joints if j.parent == body.name)
    inertial = f'<inertial pos="0 0 0" mass="{body.mass!r}" diaginertia="{numbers(*body.inertia)}"/>'
    return f"""<body name="{body.name}" pos="{numbers(*place)}" quat="{quaternion(turn)}">{moves}{inertial}
        {"".join(geom_text(shape, body) for shape in body.shapes)}{children}</body>"""


def joint_text(joint: Joint, body: Body) -> str:
    """Return a joint."""
    if joint.kind == "fixed":
        return ""
    kind = {"revolute": "hinge", "prismatic": "slide"}[joint.kind]
    anchor = numbers(*(a - p for a, p in zip(joint.anchor, body.position, strict=True)))
    limits = ""
    if math.isfinite(joint.lower) or math.isfinite(joint.upper):
        limits = f'limited="true" range="{max(joint.lower, -1e3)} {min(joint.upper, 1e3)}"'
    return (
        f'<joint name="{joint.name}" type="{kind}" pos="{anchor}" axis="{numbers(*joint.axis)}" {limits} damping="0"/>'
    )


def actuator_text(joint: Joint) -> str:
    """Return the motor of a joint."""
    limit = f'forcelimited="true" forcerange="{-joint.effort} {joint.effort}"' if joint.effort < 1e9 else ""
    if joint.motor == "velocity":
        gain = 50 * joint.effort if joint.effort < 1e9 else 1e5
        return f'<velocity name="{joint.name}" joint="{joint.name}" kv="{gain!r}" {limit}/>'
    return f'<motor name="{joint.name}" joint="{joint.name}" {limit}/>' if joint.motor else ""


def scene_text(scene: Scene) -> str:
    """Return the MJCF of a scene."""
    bodies = "".join(
        body_text(model, body)
        for model, body in scene.bodies()
        if not any(joint.child == body.name and joint.parent != "world" for joint in model.joints)
    )
    pairs = "".join(
        f'<exclude body1="{a.name}" body2="{b.name}"/>'
        for model in scene.models
        for i, a in enumerate(model.bodies)
        for b in model.bodies[i + 1 :]
    )
    motors = "".join(actuator_text(joint) for model in scene.models for joint in model.joints)
    ground = '<geom type="plane" size="100 100 1" friction="1 0 0" condim="3"/>' if scene.ground else ""
    return f"""<mujoco><compiler angle="radian"/><option timestep="{scene.step!r}" integrator="implicitfast"
        cone="elliptic" impratio="10" gravity="{numbers(*scene.gravity)}"/><size memory="256M"/>
        <worldbody>{ground}{bodies}</worldbody><contact>{pairs}</contact><actuator>{motors}</actuator></mujoco>"""


class MuJoCo:
    """A scene that MuJoCo runs."""

    name = "MuJoCo"

    def __init__(self, scene: Scene) -> None:
        """Compile the model."""
        import mujoco

        self.mujoco: Any = mujoco
        self.scene = scene
        self.model = mujoco.MjModel.from_xml_string(scene_text(scene))
        self.data = mujoco.MjData(self.model)
        mujoco.mj_forward(self.model, self.data)
        self.time = 0.0
        self.motors = {j.name: j.motor for model in scene.models for j in model.joints}

    def run(self, seconds: float, forces: Mapping[str, Vector] | None = None) -> None:
        """Run for a time; the forces act at the centres of mass meanwhile."""
        steps = round(seconds / self.scene.step)
        self.time += steps * self.scene.step
        for body, force in (forces or {}).items():
            self.data.xfrc_applied[self.model.body(body).id, :3] = force
        self.mujoco.mj_step(self.model, self.data, steps)
        self.data.xfrc_applied[:] = 0
        self.mujoco.mj_forward(self.model, self.data)

    def position(self, body: str) -> np.ndarray:
        """Return the centre of mass of a body."""
        return np.array(self.data.xipos[self.model.body(body).id])

    def orientation(self, body: str) -> np.ndarray:
        """Return a quaternion x, y, z, w."""
        w, x, y, z = self.data.xquat[self.model.body(body).id]
        return np.array([x, y, z, w])

    def motion(self, body: str) -> np.ndarray:
        """Return angular and linear velocity in world axes."""
        result = np.zeros(6)
        kind = self.mujoco.mjtObj.mjOBJ_BODY
        self.mujoco.mj_objectVelocity(self.model, self.data, kind, self.model.body(body).id, result, 0)
        return result

    def velocity(self, body: str) -> np.ndarray:
        """Return the velocity of the centre of mass."""
        return self.motion(body)[3:]

    def spin(self, body: str) -> np.ndarray:
        """Return the angular velocity, world axes."""
        return self.motion(body)[:3]

    def set_velocity(self, body: str, linear: Vector, angular: Vector = (0.0, 0.0, 0.0)) -> None:
        """Set the velocity of a body without joints."""
        first = self.model.body(body).dofadr[0]
        turn = np.zeros(9)
        self.mujoco.mju_quat2Mat(turn, self.data.xquat[self.model.body(body).id])
        self.data.qvel[first : first + 3] = linear
        self.data.qvel[first + 3 : first + 6] = turn.reshape(3, 3).T @ np.array(angular)
        self.mujoco.mj_forward(self.model, self.data)

    def set_motion(self, model: Model, linear: Vector, joint_velocities: Mapping[str, float]) -> None:
        """Move a model without turning it, while the children of these joints turn about their own centres."""
        self.set_velocity(model.bodies[0].name, linear)
        for joint, rate in joint_velocities.items():
            self.data.qvel[self.model.joint(joint).dofadr[0]] = rate
        self.mujoco.mj_forward(self.model, self.data)

    def joint_position(self, joint: str) -> float:
        """Return radians or metres."""
        return float(self.data.qpos[self.model.joint(joint).qposadr[0]])

    def joint_velocity(self, joint: str) -> float:
        """Return rad/s or m/s."""
        return float(self.data.qvel[self.model.joint(joint).dofadr[0]])

    def set_target(self, joint: str, value: float) -> None:
        """Command the motor of a joint: its velocity or its effort."""
        self.data.ctrl[self.model.actuator(joint).id] = value
