# SPDX-License-Identifier: BSD-3-Clause
"""Changes of a scene after which its motion must be the same, but for the change."""

from __future__ import annotations

import dataclasses
import math

import numpy as np

from .scene import Joint, Model, Scene, Vector, product, rotated, turned


def shifted(scene: Scene, by: Vector) -> Scene:
    """Move all models."""
    models = tuple(
        dataclasses.replace(model, position=tuple(p + d for p, d in zip(model.position, by, strict=True)))
        for model in scene.models
    )
    return dataclasses.replace(scene, models=models)


def rotated_scene(scene: Scene, angle: float) -> Scene:
    """Turn all models about the world's z axis."""
    turn = turned((0, 0, 1), angle)
    models = tuple(
        dataclasses.replace(model, position=rotated(turn, model.position), orientation=product(turn, model.orientation))
        for model in scene.models
    )
    return dataclasses.replace(scene, models=models, gravity=rotated(turn, scene.gravity))


def mirrored(scene: Scene) -> Scene:
    """Mirror the scene at the plane y = 0; its bodies and shapes must be symmetric themselves."""

    def flip(v: Vector) -> Vector:
        return (v[0], -v[1], v[2])

    def joint(of: Joint) -> Joint:
        x, y, z = of.axis
        axis = flip(of.axis) if of.kind == "prismatic" else (-x, y, -z)  # the axis of a rotation is a pseudovector
        return dataclasses.replace(of, axis=axis, anchor=flip(of.anchor))

    def model(of: Model) -> Model:
        x, y, z, w = of.orientation
        bodies = tuple(dataclasses.replace(body, position=flip(body.position)) for body in of.bodies)
        return dataclasses.replace(
            of,
            bodies=bodies,
            joints=tuple(map(joint, of.joints)),
            position=flip(of.position),
            orientation=(-x, y, -z, w),
        )

    return dataclasses.replace(scene, models=tuple(map(model, scene.models)), gravity=flip(scene.gravity))


def renamed(scene: Scene) -> Scene:
    """Put a prefix before all names, so that their alphabetical order is reversed."""
    count = len(list(scene.bodies()))
    order = {body.name: f"n{count - i:03}_{body.name}" for i, (_, body) in enumerate(scene.bodies())}

    def model(of: Model) -> Model:
        bodies = tuple(dataclasses.replace(body, name=order[body.name]) for body in of.bodies)
        joints = tuple(
            dataclasses.replace(j, name=f"n_{j.name}", parent=order.get(j.parent, j.parent), child=order[j.child])
            for j in of.joints
        )
        return dataclasses.replace(of, name=f"n{order[of.bodies[0].name]}", bodies=bodies, joints=joints)

    return dataclasses.replace(scene, models=tuple(map(model, scene.models)))


def turn_back(place: np.ndarray, angle: float) -> np.ndarray:
    """Undo `rotated_scene` for a point."""
    c, s = math.cos(angle), math.sin(angle)
    return np.array([c * place[0] + s * place[1], -s * place[0] + c * place[1], place[2]])
