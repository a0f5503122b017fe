# SPDX-License-Identifier: BSD-3-Clause
"""The palette of the window: parts that are added to the scene, as text that "Save scene as" writes."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from bubblesim.remote.window.editing import add_text, free_name
from bubblesim.remote.window.window import Window
from bubblesim.scene_state.building_parts import MATERIALS, SHAPES, Options, is_sensor, part


def get_materials(_window: Window) -> dict[str, dict[str, Any]]:
    """Return friction and colour (red, green, blue from 0 to 1) of each material."""
    return {name: {"friction": each.friction, "colour": list(each.colour)} for name, each in MATERIALS.items()}


def build(window: Window, kind: str, position: list[float], options: dict[str, Any] | None = None) -> int:
    """Add a part on the ground at a position (m), and return its handle.

    :param kind: box, sphere, cylinder, cone, capsule, lamp, spotlight, hinge, slider, lidar, camera, depth_camera,
        sonar or imu.
    :param options: ``size`` (m), ``material`` and ``fixed`` of a shape; ``carrier``, the handle of a link, of a sensor,
        which then is at the position itself and looks where the link looks.
    """
    given = dict(options or {})
    carrier = given.pop("carrier", None)
    size = [float(length) for length in given.pop("size", Options.size)]
    material, fixed = str(given.pop("material", Options.material)), bool(given.pop("fixed", False))
    if given:
        raise ValueError(f"a part has no option '{next(iter(given))}': there are size, material, fixed, carrier")
    if kind in SHAPES and len(size) != 3:
        raise ValueError(f"the size of a part is three lengths in m, found {size}")
    world = window.simulation.world
    link, orientation = "", [0.0, 0.0, 0.0, 1.0]
    if carrier is not None:
        if not is_sensor(kind):
            raise ValueError(f"a {kind} cannot be mounted on a link: only sensors can")
        link = _carrier_name(window, int(carrier))
        orientation = list(world.pose(int(carrier)))[3:]
    name = free_name(window, kind.title().replace("_", ""))
    text = part(kind, name, Options(size, material, fixed, link))
    return add_text(window, text, name, position, orientation)


def _carrier_name(window: Window, link: int) -> str:
    """Return the name of a link that moves; a file finds the first one of this name.

    :raises ValueError: for a link that is static or whose name another one has.
    """
    world = window.simulation.world
    if world.kind(link) != "link" or world.is_static(link):
        raise ValueError(f"{world.path(link)} is not a link that moves: a sensor stands on the ground without it")
    name = str(world.name(link))
    moving = [int(model) for model in world.models if not world.is_static(model)]
    same = [each for model in moving for each in world.parts(model, "link") if world.name(each) == name]
    if same[0] != link:
        raise ValueError(
            f"a sensor cannot be mounted on {world.path(link)}: {world.path(same[0])} has the same name, by which a "
            "file finds the link; rename one of them in its file"
        )
    return name


FUNCTIONS: tuple[Callable[..., Any], ...] = (get_materials, build)
