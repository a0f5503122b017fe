# SPDX-License-Identifier: BSD-3-Clause
"""How requests name objects."""

from __future__ import annotations

from typing import Any


def find_object(world: Any, name: str) -> int:
    """The handle of what a path such as /Tricycle/FrontMotor names, or a name that is unique in the scene.

    LookupError names similar ones.
    """
    handle: int = world.find(name if name.startswith("/") else f"/{name}")
    return handle
