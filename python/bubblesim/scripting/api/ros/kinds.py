# SPDX-License-Identifier: BSD-3-Clause
"""Argument kinds of `simROS` and `simROS2` functions, in addition to those of `sim`."""

from __future__ import annotations

import operator
from collections.abc import Callable, Iterable, Mapping
from typing import Annotated, Any

import numpy as np

from bubblesim.scripting.api.kinds import INTEGER, Kind, MismatchError

_INT32 = range(-(2**31), 2**31)


def _int32(value: Any) -> int:
    taken = operator.index(value)
    if taken not in _INT32:
        raise MismatchError(f"found {taken}")
    return taken


def _not_negative(value: Any) -> int:
    taken = _int32(value)
    if taken < 0:
        raise MismatchError(f"found {taken}")
    return taken


def _whole(value: Any) -> int:
    if isinstance(value, float) and value.is_integer():
        value = int(value)
    return _int32(value)


def _callback(value: Any) -> Callable[..., Any] | str:
    if not callable(value) and not isinstance(value, str):
        raise TypeError
    taken: Callable[..., Any] | str = value
    return taken


def _list(value: Any) -> list[Any]:
    is_table = isinstance(value, Mapping) and bool(value)  # an empty table of Lua may be a list
    if isinstance(value, str | bytes) or is_table or not isinstance(value, Iterable):
        raise TypeError
    return list(value)


def _pixels(value: Any) -> Any:
    if isinstance(value, np.ndarray):
        if value.dtype != np.uint8:
            raise MismatchError(f"found an array of {value.dtype}")
        return value
    return np.frombuffer(value, np.uint8)


def _service(value: Any) -> str | int:
    return value if isinstance(value, str) else _int32(value)


def _seconds(value: Any) -> float:
    taken = float(value)
    if isinstance(value, str) or not np.isfinite(taken):
        raise TypeError
    return taken


def _stamp(value: Any) -> Mapping[str, int]:
    if not isinstance(value, Mapping) or set(value) != {"sec", "nanosec"}:
        raise TypeError
    return {name: INTEGER.convert(number) for name, number in value.items()}


RosHandle = Annotated[int, Kind("a handle, an integer", _int32)]
QueueSize = Annotated[int, Kind("the size of a queue, an integer of 0 or more", _not_negative)]
Int32 = Annotated[int, Kind("a whole number of 32 bits", _whole)]
CallbackOrName = Annotated[Any, Kind("a function or the name of one", _callback)]
Transforms = Annotated[list[Any], Kind("a list of transforms", _list)]
Pixels = Annotated[Any, Kind("bytes or a numpy array of uint8", _pixels)]
ServiceOrClient = Annotated[str | int, Kind("the name of a service or the handle of a client", _service)]
Seconds = Annotated[float, Kind("a finite number", _seconds)]
Stamp = Annotated[Mapping[str, int], Kind("a time {sec, nanosec}", _stamp)]
