# SPDX-License-Identifier: BSD-3-Clause
"""ROS 2's quality of service of a topic, as far as ROS 1 has an equivalent."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

# Allowed values by key; None for keys without effect in ROS 1, which are not checked.
_KEYS: dict[str, tuple[str, ...] | None] = {
    "depth": None,
    "history": ("keep_last", "keep_all", "system_default"),
    "reliability": ("reliable", "best_effort", "system_default"),
    "durability": ("volatile", "transient_local", "system_default"),
    "deadline": None,
    "lifespan": None,
    "liveliness": None,
    "liveliness_lease_duration": None,
}


@dataclass(frozen=True)
class Qos:
    """Queue size (0: unlimited), and whether late subscribers get the last message."""

    depth: int = 1
    latch: bool = False


def read_qos(value: int | Mapping[str, Any]) -> Qos:
    """Read a queue size, or a dict such as ``{'depth': 10, 'durability': 'transient_local'}``.

    ROS 1 is always reliable, so ``reliability`` has no effect.

    :raises TypeError, ValueError: with the valid keys and values.
    """
    if not isinstance(value, Mapping):
        return Qos(_as_depth(value))
    words: dict[str, str] = {}
    for key, setting in value.items():
        if key not in _KEYS:
            raise ValueError(f"QoS has no '{key}'; valid keys: {', '.join(_KEYS)}")
        allowed = _KEYS[key]
        if allowed is None:
            continue
        words[key] = str(setting).lower()
        if words[key] not in allowed:
            raise ValueError(f"QoS {key} must be one of {', '.join(allowed)}; found {setting!r}")
    depth = 0 if words.get("history") == "keep_all" else _as_depth(value.get("depth", Qos.depth))
    return Qos(depth, latch=words.get("durability") == "transient_local")


def _as_depth(value: Any) -> int:
    if isinstance(value, float) and value.is_integer():  # a number in Lua
        value = int(value)
    if isinstance(value, bool) or not isinstance(value, int):
        raise TypeError(f"the queue size must be an integer, found {value!r}")
    if value < 0:
        raise ValueError(f"the queue size must not be negative, found {value}")
    return value
