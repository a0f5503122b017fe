# SPDX-License-Identifier: BSD-3-Clause
"""A scene in bubblesim, through its Python module."""

from __future__ import annotations

import tempfile
from collections.abc import Mapping
from pathlib import Path

import numpy as np

import bubblesim

from .scene import Body, Joint, Model, Quaternion, Scene, Shape, Vector, rotated

NO_LIMIT = 1e16
CUBE_FACES = [(0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3)]


def pose_text(position: Vector, orientation: Quaternion) -> str:
    """Return an SDFormat pose."""
    numbers = " ".join(repr(float(value)) for value in (*position, *orientation))
    return f'<pose rotation_format="quat_xyzw">{numbers}</pose>'


def cuboid_mesh(size: tuple[float, ...], folder: Path) -> Path:
    """Write a cuboid of twelve triangles, counter-clockwise from outside; return the file."""
    path = folder / ("cuboid_" + "_".join(f"{s:g}" for s in size) + ".obj")
    corners = [(x, y, z) for x in (-0.5, 0.5) for y in (-0.5, 0.5) for z in (-0.5, 0.5)]
    lines = [f"v {x * size[0]} {y * size[1]} {z * size[2]}" for x, y, z in corners]
    for a, b, c, d in CUBE_FACES:
        lines += [f"f {a + 1} {b + 1} {c + 1}", f"f {a + 1} {c + 1} {d + 1}"]
    path.write_text("\n".join(lines) + "\n")
    return path


def geometry_text(shape: Shape, folder: Path) -> str:
    """Return an SDFormat geometry."""
    numbers = [repr(float(value)) for value in shape.size]
    if shape.kind == "box":
        inside = f"<box><size>{' '.join(numbers)}</size></box>"
    elif shape.kind == "sphere":
        inside = f"<sphere><radius>{numbers[0]}</radius></sphere>"
    elif shape.kind == "cylinder":
        inside = f"<cylinder><radius>{numbers[0]}</radius><length>{numbers[1]}</length></cylinder>"
    else:
        inside = f"<mesh><uri>{cuboid_mesh(shape.size, folder)}</uri></mesh>"
    return f"<geometry>{inside}</geometry>"


def surface_text(mu: float, bounce: float, more: str = "") -> str:
    """Return an SDFormat surface; `more` stands in its <friction>."""
    return f"""<surface><friction><ode><mu>{mu!r}</mu><mu2>{mu!r}</mu2></ode>{more}</friction>
        <bounce><restitution_coefficient>{bounce!r}</restitution_coefficient><threshold>0</threshold></bounce>
        </surface>"""


def link_text(body: Body, folder: Path) -> str:
    """Return an SDFormat link."""
    ixx, iyy, izz = body.inertia
    rolling = f"<bubblesim:rolling>{body.rolling!r}</bubblesim:rolling>" if body.rolling else ""
    more = body.torsional + rolling
    shapes = "".join(
        f"""<collision name="shape{i}">{pose_text(shape.position, shape.orientation)}{geometry_text(shape, folder)}
        {surface_text(body.mu, body.bounce, more)}</collision>"""
        for i, shape in enumerate(body.shapes)
    )
    return f"""<link name="{body.name}">{pose_text(body.position, (0, 0, 0, 1))}
        <inertial><mass>{body.mass!r}</mass><inertia><ixx>{ixx!r}</ixx><iyy>{iyy!r}</iyy><izz>{izz!r}</izz></inertia>
        </inertial>{shapes}{body.sensors}</link>"""


def joint_text(joint: Joint, model: Model) -> str:
    """Return an SDFormat joint; its frame has the axes of the model."""
    child = model.body(joint.child).position
    offset = tuple(a - c for a, c in zip(joint.anchor, child, strict=True))
    axis = ""
    if joint.kind != "fixed":
        motor = f"<bubblesim:motor>{joint.motor}</bubblesim:motor>" if joint.motor else ""
        axis = f"""<axis><xyz>{" ".join(map(repr, map(float, joint.axis)))}</xyz><limit>
            <lower>{max(joint.lower, -NO_LIMIT)!r}</lower><upper>{min(joint.upper, NO_LIMIT)!r}</upper>
            <effort>{joint.effort!r}</effort></limit>{motor}</axis>"""
    return f"""<joint name="{joint.name}" type="{joint.kind}">{pose_text(offset, (0, 0, 0, 1))}
        <parent>{joint.parent}</parent><child>{joint.child}</child>{axis}{joint.sensors}</joint>"""


def model_text(model: Model, folder: Path) -> str:
    """Return an SDFormat model."""
    links = "".join(link_text(body, folder) for body in model.bodies)
    joints = "".join(joint_text(joint, model) for joint in model.joints)
    static = "<static>true</static>" if model.static else ""
    return f"""<model name="{model.name}">{static}{pose_text(model.position, model.orientation)}{links}{joints}</model>
        """


GROUND = f"""<model name="Ground"><static>true</static><link name="ground"><collision name="plane">
    <geometry><plane><normal>0 0 1</normal></plane></geometry>{surface_text(100.0, 1.0)}</collision></link></model>"""


def scene_text(scene: Scene, folder: Path, solver: str) -> str:
    """Return the SDFormat file of a scene."""
    return f"""<sdf version="1.9" xmlns:bubblesim="https://bubblesim"><world name="w">
        <physics name="p" type="ode"><max_step_size>{scene.step!r}</max_step_size>
        <bubblesim:solver>{solver}</bubblesim:solver>{scene.physics}</physics>
        <bubblesim:time_step>{scene.step * scene.substeps!r}</bubblesim:time_step>
        <gravity>{" ".join(map(repr, map(float, scene.gravity)))}</gravity>{scene.world}
        {GROUND if scene.ground else ""}
        {"".join(model_text(model, folder) for model in scene.models)}</world></sdf>"""


class Ours:
    """A scene that bubblesim runs."""

    name = "bubblesim"
    solver = "bubblesim"

    def __init__(self, scene: Scene) -> None:
        """Load the scene."""
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder) / "scene.sdf"
            path.write_text(scene_text(scene, Path(folder), self.solver))
            self.simulation = bubblesim.Simulation(bubblesim.Scene(str(path)))  # prints no warnings
        self.scene = scene
        self.time = 0.0
        self.links = {body.name: self.simulation.object(f"/{model.name}/{body.name}") for model, body in scene.bodies()}
        self.joints = {
            joint.name: self.simulation.object(f"/{model.name}/{joint.name}")
            for model in scene.models
            for joint in model.joints
        }

    def run(self, seconds: float, forces: Mapping[str, Vector] | None = None) -> None:
        """Run for a time; the forces act at the centres of mass meanwhile."""
        steps = round(seconds / (self.scene.step * self.scene.substeps))
        self.time += steps * self.scene.step * self.scene.substeps
        if not forces:
            self.simulation.step(steps)
            return
        for _ in range(steps):
            for body, force in forces.items():
                self.links[body].apply_wrench(force)
            self.simulation.step()

    def position(self, body: str) -> np.ndarray:
        """Return the centre of mass of a body."""
        return np.array(self.links[body].position)

    def orientation(self, body: str) -> np.ndarray:
        """Return a quaternion x, y, z, w."""
        return np.array(self.links[body].orientation)

    def velocity(self, body: str) -> np.ndarray:
        """Return the velocity of the centre of mass."""
        return np.array(self.links[body].linear_velocity)

    def spin(self, body: str) -> np.ndarray:
        """Return the angular velocity, world axes."""
        return np.array(self.links[body].angular_velocity)

    def set_velocity(self, body: str, linear: Vector, angular: Vector = (0.0, 0.0, 0.0)) -> None:
        """Set the velocity of a body without joints."""
        self.links[body].linear_velocity = linear
        self.links[body].angular_velocity = angular

    def set_motion(self, model: Model, linear: Vector, joint_velocities: Mapping[str, float]) -> None:
        """Move a model without turning it, while the children of these joints turn about their own centres."""
        for body in model.bodies:
            self.set_velocity(body.name, linear)
        for joint in model.joints:
            axis = rotated(model.orientation, joint.axis)
            rate = joint_velocities.get(joint.name, 0.0)
            if rate:
                self.links[joint.child].angular_velocity = [rate * a for a in axis]

    def joint_position(self, joint: str) -> float:
        """Return radians or metres."""
        return float(self.joints[joint].joint_position)

    def joint_velocity(self, joint: str) -> float:
        """Return rad/s or m/s."""
        return float(self.joints[joint].joint_velocity)

    def set_target(self, joint: str, value: float) -> None:
        """Command the motor of a joint: its velocity or its effort."""
        kind = next(j.motor for model in self.scene.models for j in model.joints if j.name == joint)
        if kind == "effort":
            self.joints[joint].target_effort = value
        else:
            self.joints[joint].target_velocity = value


class Ode(Ours):
    """The same with ODE's solver for what has joints."""

    name = "ODE"
    solver = "ode"
