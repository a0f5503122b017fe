# SPDX-License-Identifier: BSD-3-Clause
"""Readings of sensors as plain values."""

from __future__ import annotations

from collections.abc import Callable
from time import perf_counter
from typing import Any

import numpy as np

from bubblesim._core import read_sensor
from bubblesim.remote.window.window import Window

_LEFT_OUT = {"objects"}  # the page does not draw them


def _plain(value: Any) -> Any:
    if isinstance(value, np.ndarray):
        return (
            value.tolist() if value.size <= 16 and value.dtype == np.float64 else np.ascontiguousarray(value).tobytes()
        )
    if isinstance(value, list):
        return [_plain(each) for each in value]
    return _fields(value) if hasattr(value, "_fields") else value


def _fields(record: Any) -> dict[str, Any]:
    values = {name: getattr(record, name) for name in record._fields if name not in _LEFT_OUT}
    if values.get("rgb") is not None:
        del values["depth"]  # an image is drawn as it is, or by its depths
    return {name: _plain(value) for name, value in values.items() if value is not None}


def reading(window: Window, sensor: int) -> dict[str, Any]:
    """Return the last reading of a sensor, large arrays as bytes, and the ``duration`` of the measurement, s, for which
    the simulation waited."""
    begin = perf_counter()
    time, value = read_sensor(window.simulation, sensor)
    return {"type": type(value).__name__, "time": time, "duration": perf_counter() - begin, **_fields(value)}


FUNCTIONS: tuple[Callable[..., Any], ...] = (reading,)
