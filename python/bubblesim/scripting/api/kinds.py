# SPDX-License-Identifier: BSD-3-Clause
"""Argument types of script functions: the kinds used in the functions' annotations."""

from __future__ import annotations

import operator
from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass
from types import MappingProxyType
from typing import Annotated, Any


@dataclass(frozen=True)
class Kind:
    """A kind of argument: its description and conversion."""

    words: str
    convert: Callable[[Any], Any]  # raises TypeError or ValueError for invalid values
    plain: type | None = None  # type that convert() returns unchanged; None if there is none


class MismatchError(ValueError):
    """States the found value itself, when the whole value would not show the problem."""


def _number(value: Any) -> float:
    if isinstance(value, str | bytes | bytearray):  # float('1') and float(b'1') would accept it
        raise TypeError
    return float(value)


def _string(value: Any) -> str:
    if isinstance(value, bytes):  # Lua's strings hold bytes
        return value.decode()
    if not isinstance(value, str):
        raise TypeError
    return value


def _name_or_handle(value: Any) -> str | int:
    return _string(value) if isinstance(value, str | bytes) else _integer(value)


def _bytes(value: Any) -> bytes:
    return value.encode() if isinstance(value, str) else bytes(memoryview(value))


def _string_or_bytes(value: Any) -> str | bytes:
    return value if isinstance(value, str) else bytes(memoryview(value))


def _string_or_nothing(value: Any) -> str | None:
    return None if value is None else _string(value)


def _data_or_nothing(value: Any) -> str | bytes | None:
    return None if value is None else _string_or_bytes(value)


def _flag(value: Any) -> bool:
    return value if isinstance(value, bool) else operator.index(value) != 0


def _options(value: Any) -> Mapping[str, Any]:
    if value is None:
        return {}
    if not isinstance(value, Mapping):
        raise TypeError
    return value


def numbers(count: int) -> Kind:
    """Return the kind of ``count`` numbers, in a list, tuple or array; those behind them are ignored, as in
    CoppeliaSim."""

    def convert(values: Any) -> list[float]:
        taken = _numbers(values)
        if len(taken) < count:
            raise MismatchError(f"found {len(taken)}")
        return taken[:count]

    return Kind(f"{count} numbers", convert)


def _matrix(values: Any) -> list[float]:
    """Return the upper three rows of a matrix."""
    taken = _numbers(values)
    if len(taken) not in (12, 16):
        raise MismatchError(f"found {len(taken)}")
    return taken[:12]


def _numbers(values: Any) -> list[float]:
    if isinstance(values, str) or not isinstance(values, Iterable):
        raise TypeError
    return [_number(value) for value in values]


def _numbers_or_nothing(values: Any) -> list[float] | None:
    return None if values is None else _numbers(values)


def _integers(values: Any) -> list[int]:
    return [value if isinstance(value, int) else _whole(value) for value in _numbers(values)]


def _whole(value: float) -> int:
    if value != int(value):
        raise MismatchError(f"found {value:g} among them")
    return int(value)


def _integer(value: Any) -> int:
    if isinstance(value, float) and value.is_integer():  # 10 / 2 is 5.0, in Lua as in Python
        return int(value)
    return operator.index(value)


NUMBER = Kind("a number", _number, float)
INTEGER = Kind("an integer", _integer, int)
STRING = Kind("a string", _string, str)
FLAG = Kind("true or false", _flag, bool)

HANDLE = Kind("the handle of an object, an integer", _integer, int)

Handle = Annotated[int, HANDLE]
NameOrHandle = Annotated[str | int, Kind("the name of an object or sim.handle_self", _name_or_handle)]
Vector3 = Annotated[list[float], numbers(3)]
Vector4 = Annotated[list[float], numbers(4)]
Vector7 = Annotated[list[float], numbers(7)]
Vector12 = Annotated[list[float], Kind("12 or 16 numbers, the rows of a matrix", _matrix)]
Numbers = Annotated[list[float], Kind("a list of numbers", _numbers)]
NumbersOrNothing = Annotated[list[float] | None, Kind("a list of numbers or nothing", _numbers_or_nothing)]
Integers = Annotated[list[int], Kind("a list of integers", _integers)]
Bytes = Annotated[bytes, Kind("bytes", _bytes)]
TextOrBytes = Annotated[str | bytes, Kind("a string or bytes", _string_or_bytes)]
DataOrNothing = Annotated[str | bytes | None, Kind("a string, bytes or nothing", _data_or_nothing)]
StringOrNothing = Annotated[str | None, Kind("a string or nothing", _string_or_nothing)]
Options = Annotated[Mapping[str, Any], Kind("a table of options by name", _options)]

NO_OPTIONS: Mapping[str, Any] = MappingProxyType({})
PLAIN: dict[Any, Kind] = {float: NUMBER, int: INTEGER, str: STRING, bool: FLAG}


def shown(value: Any) -> str:
    """Return a value for error messages: its type and the beginning of its repr."""
    if value is None:
        return "nothing (None)"
    text = repr(value)
    return f"{type(value).__name__} {text if len(text) <= 40 else text[:37] + '...'}"
