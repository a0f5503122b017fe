# SPDX-License-Identifier: BSD-3-Clause
"""The state of single objects, for the properties of the selection."""

from __future__ import annotations

import contextlib
from collections.abc import Callable
from typing import Any

from bubblesim._core import WrongObject
from bubblesim.remote.window.window import Window


def get_state(window: Window, handle: int) -> dict[str, Any]:
    """Return the pose and velocity of an object, of a joint its axes, and the numbers that can be set.

    Poses are x, y, z (m) and the quaternion x, y, z, w in the world; velocities m/s and rad/s along the world's axes.
    """
    world = window.simulation.world
    state: dict[str, Any] = {"pose": list(world.pose(handle))}
    kind = world.kind(handle)
    state["numbers"] = _numbers(window, handle, str(kind))
    if kind in ("model", "link"):
        linear, angular = world.velocity(handle)
        state["linear_velocity"] = list(linear)
        state["angular_velocity"] = list(angular)
    elif kind == "joint":
        state["axes"] = [_axis(world, handle, axis) for axis in range(world.joint_axes(handle))]
    return state


def _numbers(window: Window, handle: int, kind: str) -> dict[str, float]:
    """Return the numbers of an object for ``set_number``."""
    world = window.simulation.world
    found: dict[str, float] = {}
    if kind in ("model", "link"):
        if not world.is_static(handle):
            found["mass"] = world.mass(handle)
        with contextlib.suppress(WrongObject):  # it has no collisions
            found["friction"] = world.friction(handle)
    elif kind == "joint" and world.joint_axes(handle):
        found["motor_gain"] = window.simulation.object(world.path(handle)).motor_gain
    elif kind == "sensor":
        found["noise_scale"] = window.simulation.object(world.path(handle)).noise_scale
    return found


def _axis(world: Any, joint: int, axis: int) -> dict[str, Any]:
    return {
        "position": world.joint_position(joint, axis),
        "velocity": world.joint_velocity(joint, axis),
        "effort": world.motor_effort(joint, axis),
        "mode": world.motor_mode(joint, axis).name.lower(),
        "target_position": world.target_position(joint, axis),
        "target_velocity": world.target_velocity(joint, axis),
        "target_effort": world.target_effort(joint, axis),
        "max_force": world.max_force(joint, axis),
    }


def get_contacts(window: Window) -> list[Any]:
    """Return x, y, z (m) and the normal force (N) of each contact point of the last physics substep."""
    points: list[Any] = window.simulation.world.contact_points()
    return points


FUNCTIONS: tuple[Callable[..., Any], ...] = (get_state, get_contacts)
