# SPDX-License-Identifier: BSD-3-Clause
"""Object names in requests."""

from __future__ import annotations

from typing import Any


def find_object(world: Any, name: str) -> int:
    """Return the handle of a path such as /Tricycle/FrontMotor, or of a name that is unique in the scene.

    Raise LookupError with similar names.
    """
    handle: int = world.find(name if name.startswith("/") else f"/{name}")
    return handle
