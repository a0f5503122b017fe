# SPDX-License-Identifier: BSD-3-Clause
"""Conversion between Lua and Python values: tables and lists or dicts, byte strings and strings, functions."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Any

import numpy as np
from lupa import lua54

from bubblesim.scripting.api.checked_calls import SurplusArgumentsError

_MAX_DEPTH = 100  # nested tables; more means that a table contains itself
_INT64 = range(-(2**63), 2**63)


class LuaScriptError(Exception):
    """An error of a Lua script; the text is its report, with the calls."""

    def __init__(self, report: bytes, *, interrupted: bool) -> None:
        """Store the report of the sandbox."""
        super().__init__(report.decode(errors="backslashreplace"))
        self.interrupted = interrupted


class LuaFunction:
    """A function of a Lua script that can be called from Python."""

    def __init__(self, values: LuaValues, function: Any, name: str) -> None:
        """Wrap ``function``; ``name`` is used in messages."""
        self.__name__ = name
        self.in_lua = function
        self._values = values

    def __call__(self, *arguments: object) -> Any:
        """Call the function; return several results as a tuple; raise LuaScriptError on failure."""
        results = self._values.run(self.in_lua, *map(self._values.to_lua, arguments))
        if len(results) == 1:
            return self._values.to_python(results[0])
        return tuple(map(self._values.to_python, results)) or None


class LuaValues:
    """Converts the values of one Lua state."""

    def __init__(
        self, runtime: lua54.LuaRuntime, place_of: Callable[[bytes, int], str], note_surplus: Callable[[str], None]
    ) -> None:
        """Create it before any globals of the Lua state are removed.

        :param place_of: returns FILE:LINE for a chunk name and a line.
        :param note_surplus: called with the error of arguments that a function does not take, which Lua ignores.
        """
        self._note_surplus = note_surplus
        self.run_in_sandbox: Callable[..., Any] | None = None  # the sandbox's function `run`
        self._new_table = runtime.table_from
        self._about = runtime.globals()[b"debug"][b"getinfo"]
        self._place_of = place_of

    def run(self, function: Any, *arguments: Any) -> tuple[Any, ...]:
        """Call a Lua function with Lua values and return its results unconverted; raise LuaScriptError on failure."""
        assert self.run_in_sandbox is not None
        results = self.run_in_sandbox(function, *arguments)
        if results is True:
            return ()
        if results[0]:
            return tuple(results[1:])
        raise LuaScriptError(results[2], interrupted=results[1])

    def to_python(self, value: Any, depth: int = 0) -> Any:
        """Convert a Lua value to Python.

        A table with the keys 1 to n becomes a list, any other, including the empty table, a dict. A string becomes a
        str if it is ASCII, which is the same in every encoding, and bytes otherwise.
        """
        if isinstance(value, bytes):
            return _text_or_bytes(value)
        kind = lua54.lua_type(value)
        if kind is None:  # nil, a number, true or false
            return value
        if kind == "table":
            return self._table_to_python(value, depth)
        if kind == "function":
            return LuaFunction(self, value, self._name(value))
        raise TypeError(f"Lua values of type {kind} are not supported")

    def to_lua(self, value: Any) -> Any:
        """Convert a Python value to Lua.

        Lists, tuples and arrays become tables with indices from 1. Integers above 2^63 - 1 wrap around to negative
        ones, as unsigned numbers do in Lua.
        """
        if value is None or isinstance(value, bool | float | bytes):
            return value
        if isinstance(value, int):
            return value if value in _INT64 else (value + 2**63) % 2**64 - 2**63
        if isinstance(value, str):
            return value.encode(errors="surrogateescape")
        if isinstance(value, Mapping):
            return self._new_table({self.to_lua(key): self.to_lua(entry) for key, entry in value.items()})
        if isinstance(value, list | tuple):
            return self._new_table([self.to_lua(entry) for entry in value])
        if isinstance(value, np.ndarray | np.generic):
            return self.to_lua(value.tolist())
        if isinstance(value, bytearray | memoryview):
            return bytes(value)
        if isinstance(value, LuaFunction):
            return value.in_lua
        raise TypeError(f"values of type {type(value).__name__} cannot be converted to Lua")

    def callable_from_lua(
        self, function: Callable[..., Any], turn_is_over: Callable[[], bool] = lambda: False
    ) -> Callable[..., tuple[Any, ...]]:
        """Wrap a Python function for Lua.

        The wrapper returns true, whether the calling thread has to yield its turn, and the results; or false and the
        error message; or false if the script is interrupted.
        """

        def call(*arguments: Any) -> tuple[Any, ...]:
            try:
                given = [self.to_python(argument) for argument in arguments]
                while given and given[-1] is None:  # a trailing nil is an omitted argument
                    given.pop()
                results = function(*given)
                if not isinstance(results, tuple):
                    results = (results,)
                return (True, turn_is_over(), *map(self.to_lua, results))
            except KeyboardInterrupt:
                return False, None
            except SurplusArgumentsError as error:
                self._note_surplus(str(error))
                return call(*arguments[: error.most])
            except Exception as error:
                return False, (str(error) or type(error).__name__).encode(errors="backslashreplace")

        return call

    def _table_to_python(self, table: Any, depth: int) -> list[Any] | dict[Any, Any] | int:
        if depth == _MAX_DEPTH:
            raise ValueError("a table contains itself, or more than 100 nested tables")
        entries = {key: self.to_python(value, depth + 1) for key, value in table.items()}
        if len(entries) == 1 and b"_object" in entries:  # of objects.lua
            return int(entries[b"_object"])
        count = len(table)
        if count and count == len(entries) and all(number in entries for number in range(1, count + 1)):
            return [entries[number] for number in range(1, count + 1)]
        return {_text_or_bytes(key) if isinstance(key, bytes) else key: entry for key, entry in entries.items()}

    def _name(self, function: Any) -> str:
        about = self._about(function, b"S")
        return f"at {self._place_of(about[b'short_src'], about[b'linedefined'])}"


def _text_or_bytes(value: bytes) -> str | bytes:
    try:
        return value.decode("ascii")
    except UnicodeDecodeError:
        return value
