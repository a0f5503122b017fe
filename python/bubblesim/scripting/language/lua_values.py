# SPDX-License-Identifier: BSD-3-Clause
"""Values between Lua and Python: tables and lists or dicts, strings of bytes and texts, functions."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Any

import numpy as np
from lupa import lua54

_DEEPEST = 100  # tables in tables; more is a table that holds itself
_INT64 = range(-(2**63), 2**63)


class LuaScriptError(Exception):
    """A script in Lua failed; the text is its report, with the calls that led there."""

    def __init__(self, report: bytes, *, broken_off: bool) -> None:
        """Take what the sandbox returned."""
        super().__init__(report.decode(errors="backslashreplace"))
        self.broken_off = broken_off


class LuaFunction:
    """A function of a Lua script that Python can call with values of Python."""

    def __init__(self, values: LuaValues, function: Any, name: str) -> None:
        """Wrap ``function``; ``name`` is what reports call it."""
        self.__name__ = name
        self.in_lua = function
        self._values = values

    def __call__(self, *arguments: object) -> Any:
        """Several results come as a tuple; raises LuaScriptError."""
        results = self._values.run(self.in_lua, *map(self._values.to_lua, arguments))
        if len(results) == 1:
            return self._values.to_python(results[0])
        return tuple(map(self._values.to_python, results)) or None


class LuaValues:
    """Converts the values of one Lua state."""

    def __init__(self, runtime: lua54.LuaRuntime, place_of: Callable[[bytes, int], str]) -> None:
        """To be made before anything is taken away from the state's globals.

        :param place_of: FILE:LINE of a chunk, by the name that Lua has for it, and a line.
        """
        self.run_in_sandbox: Callable[..., Any] | None = None  # the sandbox's function `run`
        self._new_table = runtime.table_from
        self._about = runtime.globals()[b"debug"][b"getinfo"]
        self._place_of = place_of

    def run(self, function: Any, *arguments: Any) -> tuple[Any, ...]:
        """Call a function of Lua with values of Lua, and return its results as they are; raises LuaScriptError."""
        assert self.run_in_sandbox is not None
        results = self.run_in_sandbox(function, *arguments)
        if results is True:
            return ()
        if results[0]:
            return tuple(results[1:])
        raise LuaScriptError(results[2], broken_off=results[1])

    def to_python(self, value: Any, depth: int = 0) -> Any:
        """Turn a value of Lua into one of Python.

        A table with the keys 1 to n becomes a list, any other, the empty one included, a dict. A string becomes a str
        when it is ASCII, which means the same in every encoding, and bytes otherwise.
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
        raise TypeError(f"a {kind} of Lua means nothing here")

    def to_lua(self, value: Any) -> Any:
        """Turn a value of Python into one of Lua.

        Lists, tuples and arrays become tables that count from 1. Integers above 2^63 - 1 turn over to negative ones, as
        unsigned numbers do in Lua.
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
        raise TypeError(f"Lua has nothing like {type(value).__name__}")

    def callable_from_lua(
        self, function: Callable[..., Any], turn_is_over: Callable[[], bool] = lambda: False
    ) -> Callable[..., tuple[Any, ...]]:
        """Let Lua call a function of Python.

        It returns true, whether the thread that called has to give its turn back, and the results; or false and what
        went wrong; or false when the script is to be broken off.
        """

        def call(*arguments: Any) -> tuple[Any, ...]:
            try:
                given = [self.to_python(argument) for argument in arguments]
                while given and given[-1] is None:  # a nil at the end is an argument left out
                    given.pop()
                results = function(*given)
                if not isinstance(results, tuple):
                    results = (results,)
                return (True, turn_is_over(), *map(self.to_lua, results))
            except KeyboardInterrupt:
                return False, None
            except Exception as error:
                return False, (str(error) or type(error).__name__).encode(errors="backslashreplace")

        return call

    def _table_to_python(self, table: Any, depth: int) -> list[Any] | dict[Any, Any]:
        if depth == _DEEPEST:
            raise ValueError("a table holds itself, or tables more than a hundred deep")
        entries = {key: self.to_python(value, depth + 1) for key, value in table.items()}
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
