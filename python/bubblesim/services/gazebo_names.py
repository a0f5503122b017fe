# SPDX-License-Identifier: BSD-3-Clause
"""Names as in Gazebo: models by name, links as model::link, the world as "", world or map."""

from __future__ import annotations

from typing import Any

from bubblesim.services.names import find_object

_WORLD = ("", "world", "map", "/map")


def find_entity(world: Any, name: str, *kinds: str) -> int:
    """Return the handle of an object of one of these kinds; raise LookupError with similar names."""
    handle = find_object(world, name.replace("::", "/"))
    if world.kind(handle) not in kinds:
        raise LookupError(f"'{name}' is a {world.kind(handle)}, not a {' or '.join(kinds)}")
    return handle


def find_frame(world: Any, name: str) -> int | None:
    """Return the handle of a reference model or link, None for the world."""
    return None if name in _WORLD else find_entity(world, name, "model", "link")


def links_of(world: Any, model: int) -> list[int]:
    """Return the handles of a model's links."""
    return [child for child in world.children(model) if world.kind(child) == "link"]
