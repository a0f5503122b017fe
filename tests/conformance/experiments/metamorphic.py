# SPDX-License-Identifier: BSD-3-Clause
"""The same scene elsewhere, turned, mirrored, in another order or with other names moves in the same way."""

from __future__ import annotations

import dataclasses
from collections.abc import Callable
from typing import Any

import numpy as np

from .experiment import Experiment, Tolerance
from .scene import GRAVITY, Model, Scene, Vector, box, sphere, turned
from .transforms import mirrored, renamed, rotated_scene, shifted, turn_back
from .vehicles import cart

SECONDS = 2.0
ANGLE = 0.7  # rad
SPEEDS = {"front_left_axle": 6.0, "rear_left_axle": 6.0, "front_right_axle": 9.0, "rear_right_axle": 9.0}


def scenery() -> Scene:
    """Return a cart that turns left and pushes boxes, with a rolling ball and a box that slides."""
    robot = cart(0.2, mu=0.8)
    shaped = dataclasses.replace(robot.bodies[0], shapes=(box("b", (0.6, 0.3, 0.1), (0, 0, 0)).bodies[0].shapes))
    robot = dataclasses.replace(robot, bodies=(shaped, *robot.bodies[1:]))
    others = (
        box("first", (0.3, 0.3, 0.3), (0.9, 0.1, 0.15), mass=2.0, mu=0.5),
        box("second", (0.2, 0.4, 0.3), (1.4, 0.3, 0.15), mass=1.0, mu=0.5, orientation=turned((0, 0, 1), 0.3)),
        box("falling", (0.2, 0.2, 0.2), (3, 2, 0.5), mu=0.4, orientation=turned((0.6, 0.8, 0.0), 0.4)),
        sphere("ball", 0.1, (-1, 1, 0.4), bounce=0.5),
    )
    return Scene((robot, *others), substeps=10)


def props() -> Scene:
    """Return the same without the cart, on a slope of 31 degrees, down which boxes slide and tumble."""
    slope: Vector = (GRAVITY * 0.4, GRAVITY * 0.3, -GRAVITY * 0.85)
    return dataclasses.replace(scenery(), models=scenery().models[1:], gravity=slope)


def final_places(engine: Any, scene: Scene, prefix: str = "", split: int = 1) -> list[np.ndarray]:
    """Return the places of all bodies at the end, in the order of `scenery`."""
    world = engine(scene)
    for joint, speed in SPEEDS.items():
        if any(prefix + joint == j.name for model in scene.models for j in model.joints):
            world.set_target(prefix + joint, speed)
    for _ in range(split):
        world.run(SECONDS / split)
    return [world.position(body.name) for _, body in scene.bodies()]


def difference(a: list[np.ndarray], b: list[np.ndarray]) -> float:
    """Return the greatest distance between places of the same body."""
    return max(float(np.linalg.norm(p - q)) for p, q in zip(a, b, strict=True))


def translation(engine: Any, scene: Scene) -> float:
    """Return the difference between a run at the origin and one 10 km away."""
    far = (6000.0, -8000.0, 0.0)
    places = [place - np.array(far) for place in final_places(engine, shifted(scene, far))]
    return difference(final_places(engine, scene), places)


def rotation(engine: Any, scene: Scene) -> float:
    """Return the difference after a turn of the whole scene about the vertical."""
    places = [turn_back(place, ANGLE) for place in final_places(engine, rotated_scene(scene, ANGLE))]
    return difference(final_places(engine, scene), places)


def mirror(engine: Any, scene: Scene) -> float:
    """Return the difference to the mirrored scene."""
    places = [place * np.array([1, -1, 1]) for place in final_places(engine, mirrored(scene))]
    return difference(final_places(engine, scene), places)


def order(engine: Any, scene: Scene) -> float:
    """Return the difference after a change of the order of the models."""
    places = final_places(engine, dataclasses.replace(scene, models=tuple(reversed(scene.models))))
    names = [body.name for model in reversed(scene.models) for body in model.bodies]
    by_name = dict(zip(names, places, strict=True))
    return difference(final_places(engine, scene), [by_name[body.name] for _, body in scene.bodies()])


def split(engine: Any, scene: Scene) -> float:
    """Return the difference between one call and forty for the same time."""
    return difference(final_places(engine, scene), final_places(engine, scene, split=40))


def grouping(engine: Any, scene: Scene) -> float:
    """Return the difference between simulation steps of ten substeps and of one."""
    fine = dataclasses.replace(scene, substeps=1)
    return difference(final_places(engine, scene), final_places(engine, fine))


def renaming(engine: Any, scene: Scene) -> float:
    """Return the difference after new names."""
    return difference(final_places(engine, scene), final_places(engine, renamed(scene), prefix="n_"))


def heap(at: float = 50.0) -> tuple[Model, ...]:
    """Return eight boxes that fall on each other, far away."""
    return tuple(
        box(
            f"heap{i}",
            (0.3, 0.3, 0.3),
            (at + 0.1 * (i % 2), 0.1 * (i // 2 % 2), 0.16 + 0.35 * i),
            mass=3.0,
            orientation=turned((0, 0, 1), 0.3 * i),
        )
        for i in range(8)
    )


def far_objects(engine: Any, scene: Scene) -> float:
    """Return the difference after a heap of eight boxes was added 50 m away."""
    crowded = dataclasses.replace(scene, models=(*scene.models, *heap()))
    count = len(list(scene.bodies()))
    return difference(final_places(engine, scene), final_places(engine, crowded)[:count])


RUNS: dict[str, Callable[[Any, Scene], float]] = {
    "translation by 10 km": translation,
    "rotation": rotation,
    "mirror": mirror,
    "order of models": order,
    "split of a run": split,
    "substeps in a step": grouping,
    "renaming": renaming,
    "far objects": far_objects,
}


def same(change: str) -> float:
    """The laws of motion are the same everywhere, in each direction and in a mirror (Galilei, Noether)."""
    return 0.0


def changed(engine: Any, change: str) -> float:
    """Return the greatest difference of a body's place after 2 s, m."""
    return RUNS[change](engine, scenery())


def changed_props(engine: Any, change: str) -> float:
    """Return the same for a scene without the cart."""
    return RUNS[change](engine, props())


CHANGES = tuple({"change": change} for change in ("translation by 10 km", "rotation", "mirror", "order of models"))
EXPERIMENTS = [
    Experiment(
        "same_bits",
        "Same scene, same bits: difference after 2 s",
        "m",
        same,
        changed,
        Tolerance("the same operations in the same order: no difference", absolute=1e-300),
        tuple({"change": change} for change in ("split of a run", "substeps in a step", "renaming", "far objects")),
        peers=(),
    ),
    Experiment(
        "same_props",
        "Boxes on a slope elsewhere, turned, mirrored or in another order: difference after 2 s",
        "m",
        same,
        changed_props,
        Tolerance("rounding (2e-12 m at 10 km), which impacts amplify", absolute=1e-4),
        CHANGES,
    ),
    Experiment(
        "same_motion",
        "Cart that pushes boxes elsewhere, turned, mirrored or in another order: difference after 2 s",
        "m",
        same,
        changed,
        Tolerance("a wheel that is about to slip slips in another substep: 8 % of the way of 1.3 m", absolute=0.1),
        CHANGES,
    ),
]
