# SPDX-License-Identifier: BSD-3-Clause
"""ROS 2's quality of service of a topic, as scripts give it."""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import Any

from bubblesim import _core

# Allowed values by key; None for numbers and times.
_KEYS: dict[str, tuple[str, ...] | None] = {
    "depth": None,
    "history": ("keep_last", "keep_all", "system_default"),
    "reliability": ("reliable", "best_effort", "system_default"),
    "durability": ("volatile", "transient_local", "system_default"),
    "deadline": None,
    "lifespan": None,
    "liveliness": ("automatic", "manual_by_topic", "system_default"),
    "liveliness_lease_duration": None,
}


def read_qos(value: int | Mapping[str, Any], is_ros2: bool, *, keeps_last: bool = False) -> _core.Qos:
    """Read a queue size, or a dict such as ``{'depth': 10, 'durability': 'transient_local'}``.

    ROS 1 is always reliable and knows no times, so these keys have no effect there.

    :param keeps_last: the publisher is to keep messages for late subscribers, whatever ``value`` has.
    :raises TypeError, ValueError: with the valid keys and values.
    """
    if not isinstance(value, Mapping):
        return _core.Qos(_as_depth(value), transient_local=keeps_last)
    words: dict[str, str] = {}
    for key, setting in value.items():
        if key not in _KEYS:
            raise ValueError(f"QoS has no '{key}'; valid keys: {', '.join(_KEYS)}")
        allowed = _KEYS[key]
        if allowed is None or (key == "liveliness" and not is_ros2):
            continue
        words[key] = str(setting).lower()
        if words[key] not in allowed:
            raise ValueError(f"QoS {key} must be one of {', '.join(allowed)}; found {setting!r}")
    if words.get("liveliness") == "manual_by_topic":
        raise ValueError("QoS liveliness must be automatic: manual_by_topic is not supported")
    if is_ros2 and _as_seconds("liveliness_lease_duration", value) is not None:
        raise ValueError("QoS liveliness_lease_duration is not supported: leave it out")
    return _core.Qos(
        0 if words.get("history") == "keep_all" else _as_depth(value.get("depth", 1)),
        transient_local=keeps_last or words.get("durability") == "transient_local",
        reliable=words.get("reliability") != "best_effort",
        lifespan=_as_seconds("lifespan", value) if is_ros2 else None,
        deadline=_as_seconds("deadline", value) if is_ros2 else None,
    )


def _as_depth(value: Any) -> int:
    if isinstance(value, float) and value.is_integer():  # a number in Lua
        value = int(value)
    if isinstance(value, bool) or not isinstance(value, int):
        raise TypeError(f"the queue size must be an integer, found {value!r}")
    if value < 0:
        raise ValueError(f"the queue size must not be negative, found {value}")
    return value


def _as_seconds(key: str, given: Mapping[str, Any]) -> float | None:
    """Return a time in seconds, given as a number or as {sec, nanosec}; None for none: 0 or infinite."""
    value = given.get(key, 0)
    if isinstance(value, Mapping) and set(value) <= {"sec", "nanosec"}:
        value = value.get("sec", 0) + value.get("nanosec", 0) * 1e-9
    if isinstance(value, bool) or not isinstance(value, int | float) or math.isnan(value) or value < 0:
        raise ValueError(f"QoS {key} must be seconds or {{sec, nanosec}}, found {given[key]!r}")
    return None if value == 0 or value > 2**31 - 2 else float(value)
