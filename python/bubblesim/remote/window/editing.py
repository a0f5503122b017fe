# SPDX-License-Identifier: BSD-3-Clause
"""Changes of the scene by hand: moving, removing, copying and adding models, joints, a spring at the mouse.

Each change that can be undone returns what undoes it: a function of the window and its arguments.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Any

from bubblesim._core import MotorMode, PointSpring, add_copy, copy_model, scene_folders
from bubblesim.remote.window.window import MOST_REMOVED, ModelCopy, Source, Window, WindowClient
from bubblesim.scene_state import set_numbers

_SPRING = "spring"


def set_pose(window: Window, handle: int, pose: list[float]) -> None:
    """Move a model or a link: x, y, z (m) and the quaternion x, y, z, w in the world. It is at rest then.

    A pose that is set while the simulation is stopped is that of the next start.
    """
    world = window.simulation.world
    world.set_state(handle, pose, [0.0, 0.0, 0.0], [0.0, 0.0, 0.0])
    window.edits.note_pose(world, handle)


def set_velocity(window: Window, handle: int, linear: list[float], angular: list[float]) -> None:
    """Set the velocity of a model or a link, m/s and rad/s along the world's axes."""
    world = window.simulation.world
    world.set_state(handle, list(world.pose(handle)), linear, angular)


def set_color(window: Window, handle: int, color: list[float]) -> None:
    """Give all visuals of a link or model one colour, which cameras see: red, green, blue from 0 to 1."""
    window.edits.colours.set(window.simulation, handle, color)


def set_number(window: Window, handle: int, name: str, value: float) -> None:
    """Set a number of an object, see ``get_state``: mass (kg), friction, motor_gain or noise_scale.

    Mass and friction that are set while the simulation is stopped stay; all others end with the run.
    """
    if name in set_numbers.NAMES:
        window.edits.numbers.set(window.simulation.world, handle, name, value, stays=window.edits.stopped())
    elif name in ("motor_gain", "noise_scale"):
        setattr(window.simulation.object(window.simulation.world.path(handle)), name, value)
    else:
        raise ValueError(f"'{name}' cannot be set: there are mass, friction, motor_gain and noise_scale")


def set_joint_target(window: Window, joint: int, axis: int, mode: str, value: float) -> None:
    """Set a motor's target: ``mode`` is position, velocity, effort or none; rad or m, rad/s or m/s, N m or N."""
    world = window.simulation.world
    world.set_motor_mode(joint, getattr(MotorMode, mode.upper()), axis)
    if mode != "none":
        getattr(world, f"set_target_{mode}")(joint, value, axis)


def set_joint_position(window: Window, joint: int, position: float) -> None:
    """Move what is below a joint so that it has this position, rad or m."""
    window.simulation.world.set_joint_position(joint, position)


def remove(window: Window, model: int) -> int:
    """Remove a top-level model; return a number with which ``restore`` brings it back."""
    kept = _keep(window, model)
    window.host.remove_model(model)
    return window.keep_removed(kept)


def restore(window: Window, number: int) -> int:
    """Bring back a removed model where it was; return its new handle."""
    kept = window.removed.get(number)
    if kept is None:
        raise LookupError(f"only the last {MOST_REMOVED} models that were removed can be brought back")
    return _add(window, kept, kept.copy.position, kept.copy.orientation)


def duplicate(window: Window, model: int, pose: list[float]) -> int:
    """Add a copy of a model at a pose in the world; return its handle."""
    return _add(window, _keep(window, model), pose[:3], pose[3:])


def add_model(window: Window, name: str, position: list[float]) -> int:
    """Add a model of the model folders, under a free name, moved by ``position`` (m); return its handle."""
    own = Path(window.simulation.scene_file).parent
    for folder in [own, *map(Path, scene_folders())]:
        file = folder / "models" / name / "model.sdf"
        if "/" not in name and file.is_file():
            break
    else:
        raise LookupError(f"there is no model '{name}' in the folders of models")
    return add_text(window, file.read_text(encoding="utf-8"), free_name(window, name), position)


def add_text(
    window: Window, text: str, name: str, position: Sequence[float], orientation: Sequence[float] = (0, 0, 0, 1)
) -> int:
    """Add a model from its text, moved by a position (m) and a quaternion x, y, z, w; return its handle."""
    model = window.simulation.add_model(text, name=name, position=position, orientation=orientation)
    _note_source(window, int(model.handle), Source(text=text))
    return int(model.handle)


def grip(window: Window, link: int, point: list[float]) -> None:
    """Pull a link by a spring at this point (m, in its frame), until the client calls ``let_go`` or leaves."""
    client = window.client
    spring = window.springs.get(client)
    if spring is None:
        spring = window.springs[client] = PointSpring(window.simulation)
        client.at_leave[_SPRING] = lambda: _release(window, client)
    spring.grip(link, point)


def pull(window: Window, target: list[float]) -> None:
    """Move the end of the client's spring."""
    spring = window.springs.get(window.client)
    if spring is not None:
        spring.pull_to(target)


def let_go(window: Window) -> None:
    """Release what the client has gripped."""
    window.client.at_leave.pop(_SPRING, None)
    _release(window, window.client)


def _release(window: Window, client: WindowClient) -> None:
    spring = window.springs.pop(client, None)
    if spring is not None:
        spring.remove()


def _keep(window: Window, model: int) -> ModelCopy:
    """Return what is needed to add a model again."""
    edits, world = window.edits, window.simulation.world
    text = edits.sources.get(model)
    original = edits.originals.get(model, str(world.name(model))) if text is None else None
    source = Source(text, original)
    return ModelCopy(
        copy_model(window.simulation, model), source, edits.colours.of(world, model), edits.numbers.of(world, model)
    )


def _add(window: Window, kept: ModelCopy, position: Sequence[float], orientation: Sequence[float]) -> int:
    name = free_name(window, kept.copy.name)
    handle: int = add_copy(window.simulation, kept.copy, name, position, orientation)
    _note_source(window, handle, kept.source)
    window.edits.colours.give(window.simulation, handle, kept.colours)
    window.edits.numbers.give(window.simulation.world, handle, kept.numbers)
    return handle


def _note_source(window: Window, model: int, source: Source) -> None:
    if source.text is not None:
        window.edits.sources[model] = source.text
    if source.original is not None:
        window.edits.originals[model] = source.original


def free_name(window: Window, name: str) -> str:
    """Return the name, or the name with the next free number."""
    world = window.simulation.world
    taken = {world.name(model) for model in world.models}
    if name not in taken:
        return name
    stem = re.sub(r"_\d+$", "", name)
    number = 1
    while f"{stem}_{number}" in taken:
        number += 1
    return f"{stem}_{number}"


FUNCTIONS: tuple[Callable[..., Any], ...] = (
    set_pose,
    set_velocity,
    set_color,
    set_number,
    set_joint_target,
    set_joint_position,
    remove,
    restore,
    duplicate,
    add_model,
    grip,
    pull,
    let_go,
)
