# SPDX-License-Identifier: BSD-3-Clause
"""Random messages as plain dicts, and their bytes from rospy's serialization."""

from __future__ import annotations

import io
import math
from functools import cache
from typing import Any

import genpy
import genpy.dynamic
import genpy.message
import numpy as np
from genmsg.msgs import parse_type
from hypothesis import strategies as st

from bubblesim import _core

codec = _core.messages

_WIDTHS = {f"{sign}int{bits}": (sign, bits) for sign in ("", "u") for bits in (8, 16, 32, 64)}
_WIDTHS |= {"byte": ("", 8), "char": ("u", 8)}


@cache
def genpy_class(name: str) -> type[genpy.Message]:
    """Return rospy's class of a message, or of a service's request or response."""
    if name in HALVES:
        service, half = HALVES[name]
        return getattr(genpy.message.get_service_class(service), f"_{half}_class")
    # test_msgs has a class only if its package was built; genpy can make one.
    return genpy.message.get_message_class(name) or genpy.dynamic.generate_dynamic(name, codec.definition(name))[name]


HALVES = {
    half: (service, kind)
    for service in codec.service_names()
    for half, kind in zip(codec.service_halves(service), ("request", "response"), strict=True)
}
ALL_TYPES = [*codec.message_names(), *HALVES]


@cache
def values(spelling: str) -> st.SearchStrategy[Any]:
    """Return values of a field type such as "float64[36]"; limits and special numbers are likely."""
    base, is_array, length = parse_type(spelling)
    if is_array:
        least, most = (0, 3) if length is None else (length, length)
        if base in ("uint8", "char"):
            return st.binary(min_size=least, max_size=most)
        return st.lists(values(base), min_size=least, max_size=most)
    if base in _WIDTHS:
        sign, bits = _WIDTHS[base]
        return st.integers(0, 2**bits - 1) if sign else st.integers(-(2 ** (bits - 1)), 2 ** (bits - 1) - 1)
    if base in ("time", "duration"):
        secs = st.integers(0, 2**32 - 1) if base == "time" else st.integers(-(2**31), 2**31 - 1)
        return st.fixed_dictionaries({"secs": secs, "nsecs": st.integers(0, 999_999_999)})
    simple: dict[str, st.SearchStrategy[Any]] = {
        "bool": st.booleans(),
        "string": st.text(max_size=6),
        "float32": st.floats(width=32),
        "float64": st.floats(),
    }
    return simple[base] if base in simple else messages(base)


@cache
def messages(name: str) -> st.SearchStrategy[dict[str, Any]]:
    """Return dicts of a message type with all its fields."""
    cls = genpy_class(name)
    return st.fixed_dictionaries(
        {field: values(kind) for field, kind in zip(cls.__slots__, cls._slot_types, strict=True)}
    )


def genpy_message(name: str, message: dict[str, Any]) -> genpy.Message:
    """Convert a dict to rospy's message object."""
    cls = genpy_class(name)
    made = cls()
    for field, kind in zip(cls.__slots__, cls._slot_types, strict=True):
        setattr(made, field, _genpy_value(kind, message[field]))
    return made


def _genpy_value(spelling: str, value: Any) -> Any:
    base, is_array, _ = parse_type(spelling)
    if is_array:
        return value if isinstance(value, bytes) else [_genpy_value(base, item) for item in value]
    if base == "time":
        return genpy.Time(value["secs"], value["nsecs"])
    if base == "duration":
        return genpy.Duration(value["secs"], value["nsecs"])
    return genpy_message(base, value) if "/" in base else value


def genpy_bytes(name: str, message: dict[str, Any]) -> bytes:
    """Return what rospy would send."""
    buffer = io.BytesIO()
    genpy_message(name, message).serialize(buffer)
    return buffer.getvalue()


def same(a: Any, b: Any) -> bool:
    """Return whether two values are equal; numpy arrays equal lists and NaN equals itself."""
    if isinstance(a, np.ndarray):
        a = a.tolist()
    if isinstance(a, dict):
        return list(a) == list(b) and all(same(a[key], b[key]) for key in a)
    if isinstance(a, list):
        return len(a) == len(b) and all(map(same, a, b))
    if isinstance(a, float) and math.isnan(a):
        return isinstance(b, float) and math.isnan(b)
    return type(a) is type(b) and bool(a == b)
