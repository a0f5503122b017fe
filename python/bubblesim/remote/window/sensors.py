# SPDX-License-Identifier: BSD-3-Clause
"""Readings of sensors as plain values."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np

from bubblesim._core import read_sensor
from bubblesim.remote.window.window import Window

_FIELDS = (
    *("detected", "distance", "point", "normal", "handle"),
    *("ranges", "intensities"),
    *("width", "height", "horizontal_fov", "near", "far", "rgb", "depth"),
    *("orientation", "angular_velocity", "linear_acceleration"),
    *("latitude", "longitude", "altitude", "velocity", "field", "force", "torque"),
)


def _plain(value: Any) -> Any:
    if isinstance(value, np.ndarray):
        return (
            value.tolist() if value.size <= 16 and value.dtype == np.float64 else np.ascontiguousarray(value).tobytes()
        )
    return value


def reading(window: Window, sensor: int) -> dict[str, Any]:
    """Return the last reading of a sensor: its fields, large arrays as bytes."""
    time, value = read_sensor(window.simulation, sensor)
    result: dict[str, Any] = {"type": type(value).__name__, "time": time}
    for name in _FIELDS:
        field = getattr(value, name, None)
        if field is None or (name == "depth" and "rgb" in result):
            continue
        if name != "rgb" or field.size:  # of a depth camera it is empty
            result[name] = _plain(field)
    for contact in getattr(value, "contacts", ()):
        points = [
            {"position": _plain(p.position), "normal": _plain(p.normal), "depth": p.depth, "force": _plain(p.force)}
            for p in contact.points
        ]
        result.setdefault("contacts", []).append(
            {"collision": contact.collision, "other": contact.other, "force": _plain(contact.force), "points": points}
        )
    return result


FUNCTIONS: tuple[Callable[..., Any], ...] = (reading,)
