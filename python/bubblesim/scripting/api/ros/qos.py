# SPDX-License-Identifier: BSD-3-Clause
"""What ROS 2 calls the quality of service of a topic, as far as ROS 1 has a counterpart."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

# By key, the values that it takes; None for those that mean nothing in ROS 1 and are not looked at.
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
    """Messages that may wait (0: no limit), and whether late subscribers get the last one."""

    depth: int = 1
    latch: bool = False


def read_qos(value: int | Mapping[str, Any]) -> Qos:
    """Read a queue size, or a dict such as ``{'depth': 10, 'durability': 'transient_local'}``.

    ROS 1 is always reliable, so that ``reliability`` changes nothing.

    :raises TypeError, ValueError: with the keys and values that are known.
    """
    if not isinstance(value, Mapping):
        return Qos(_as_depth(value))
    words: dict[str, str] = {}
    for key, setting in value.items():
        if key not in _KEYS:
            raise ValueError(f"QoS has no '{key}'; it has {', '.join(_KEYS)}")
        allowed = _KEYS[key]
        if allowed is None:
            continue
        words[key] = str(setting).lower()
        if words[key] not in allowed:
            raise ValueError(f"QoS {key} is one of {', '.join(allowed)}; found {setting!r}")
    depth = 0 if words.get("history") == "keep_all" else _as_depth(value.get("depth", Qos.depth))
    return Qos(depth, latch=words.get("durability") == "transient_local")


def _as_depth(value: Any) -> int:
    if isinstance(value, float) and value.is_integer():  # a number of Lua
        value = int(value)
    if isinstance(value, bool) or not isinstance(value, int):
        raise TypeError(f"a queue size is a whole number, found {value!r}")
    if value < 0:
        raise ValueError(f"a queue size is not negative, found {value}")
    return value
