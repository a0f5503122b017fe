# SPDX-License-Identifier: BSD-3-Clause
"""The code of a child script in Lua, in a Lua state of its own."""

from __future__ import annotations

import re
import threading
from collections.abc import Callable
from pathlib import Path
from typing import Any

from lupa import lua54

from bubblesim.scripting.api import functions
from bubblesim.scripting.lua_thread import LuaThread
from bubblesim.scripting.lua_values import BROKEN_OFF, LuaFunction, LuaValues
from bubblesim.scripting.script_output import print_line
from bubblesim.scripting.source import ScriptSourceError, find_file, read_text

_SANDBOX = Path(__file__).with_name("sandbox.lua")
_SECONDS_TO_TELL = 0.3
_MOST_MEMORY = 1 << 30  # bytes; a script that needs more ends with "not enough memory"


class LuaCode:
    """See ScriptCode."""

    def __init__(
        self,
        file: Path,
        text: str,
        search_paths: list[Path],
        modules: dict[str, Any],
        prefix: Callable[[], str],
        *,
        unsafe: bool,
    ) -> None:
        """Compile the ``text`` of ``file`` without running it.

        :param modules: what the script finds under the names ``sim``, ``simROS``, ``simROS2``.
        :param prefix: of the lines that it prints.
        :param unsafe: leave the script the libraries that reach outside: ``os``, ``io``, ``debug``, ``package``.
        :raises ScriptSourceError: when it cannot be read or is no Lua.
        """
        self._folders = [file.parent, *search_paths]
        self._thread: LuaThread | None = None
        self._files: dict[str, Path] = {}  # by the names that Lua knows them by
        self._prefix = prefix
        self._place_wanted = False
        self._place = ""
        self._place_told = threading.Event()
        self._runtime = lua54.LuaRuntime(
            encoding=None,  # strings are bytes
            unpack_returned_tuples=True,
            register_eval=False,
            register_builtins=False,
            attribute_filter=_no_attributes,
            max_memory=_MOST_MEMORY,
        )
        self._values = LuaValues(self._runtime)
        self._furnish(modules, unsafe=unsafe)
        source = _as_lua(text)
        try:
            self._body = self._runtime.compile(source, name=self._chunk_name(file), mode=b"t")
        except lua54.LuaError as error:
            raise ScriptSourceError(self._with_whole_paths(_message(error))) from error

    @property
    def files(self) -> set[Path]:
        """What the script was read from so far."""
        return set(self._files.values())

    def run(self) -> None:
        """Run the body of the script."""
        self._body()

    def function(self, name: str) -> Callable[..., Any] | None:
        """Find a global function of the script."""
        value = self._runtime.globals()[name.encode()]
        return LuaFunction(self._values, value, name) if lua54.lua_type(value) == "function" else None

    def make_thread(self, name: str, body: Callable[..., Any], prepare: Callable[[], object]) -> LuaThread:
        """Make a coroutine that runs ``body``, a function of the script."""
        assert isinstance(body, LuaFunction)
        self._thread = LuaThread(self._new_thread(body.in_lua))
        return self._thread

    def broken_off(self, error: BaseException) -> bool:
        """Whether the script failed for it was interrupted."""
        return isinstance(error, KeyboardInterrupt) or BROKEN_OFF.decode() in _message(error).partition("\n")[0]

    def where_now(self, thread: int) -> str:
        """FILE:LINE where the script is that runs in another thread, or nothing."""
        self._place_told.clear()
        self._place_wanted = True
        return self._place if self._place_told.wait(_SECONDS_TO_TELL) else ""

    def _tell_place(self, chunk: bytes, line: int) -> None:
        self._place_wanted = False
        self._place = self._with_whole_paths(f"{chunk.decode(errors='replace')}:{line}:").removesuffix(":")
        self._place_told.set()

    def place(self, error: BaseException) -> str:
        """FILE:LINE where the script failed, or nothing."""
        match = re.match(r"(.*?):(\d+): ", self._with_whole_paths(_message(error)))
        return f"{match[1]}:{match[2]}" if match else ""

    def report(self, error: BaseException) -> str:
        """What went wrong, and the calls that led there, the last one first."""
        lines = self._with_whole_paths(_message(error)).splitlines()
        return "\n".join(line for line in lines if "[C]:" not in line and "[sandbox]" not in line)

    def _furnish(self, modules: dict[str, Any], *, unsafe: bool) -> None:
        to_lua, callable_from_lua = self._values.to_lua, self._values.callable_from_lua
        host = self._runtime.table()
        host[b"modules"] = self._runtime.table_from(
            {name.encode(): self._module(module) for name, module in modules.items() if module is not None}
        )
        host[b"write"] = lambda line: print_line(self._prefix(), line.decode(errors="backslashreplace"))
        host[b"find_source"] = callable_from_lua(self._find_source)
        host[b"pulse"] = self._pulse
        host[b"tell_place"] = self._tell_place
        host[b"unsafe"] = to_lua(unsafe)
        self._new_thread = self._runtime.execute(_SANDBOX.read_bytes(), host, name=b"=[sandbox]")

    def _turn_is_over(self) -> bool:
        return self._thread is not None and self._thread.turn_is_over()

    def _pulse(self) -> bool:
        """Let signals in: Python looks for them when it enters a function. Returns whether to tell the place."""
        if self._thread is not None:
            self._thread.check_that_it_may_go_on()
        return self._place_wanted

    def _module(self, module: Any) -> Any:
        constants = {
            name: getattr(module, name)
            for name in dir(module)
            if not name.startswith("_") and isinstance(getattr(module, name), int | float | str)
        }
        table = self._runtime.table()
        table[b"constants"] = self._values.to_lua(constants)
        table[b"functions"] = self._runtime.table_from(
            {
                function.name.encode(): self._values.callable_from_lua(
                    getattr(module, function.name), self._turn_is_over
                )
                for function in functions(type(module))
            }
        )
        return table

    def _find_source(self, name: str) -> tuple[bytes, bytes]:
        """Text and chunk name of a Lua file that the script requires."""
        file = find_file(f"{name.replace('.', '/')}.lua", self._folders)
        return _as_lua(read_text(file)), self._chunk_name(file)

    def _chunk_name(self, file: Path) -> bytes:
        """Lua cuts long names: it gets those of files without their folders."""
        self._files[file.name] = file
        return b"@" + file.name.encode()

    def _with_whole_paths(self, text: str) -> str:
        for name, file in self._files.items():
            text = re.sub(rf"(?<![\w/.-]){re.escape(name)}(?=:\d+:)", str(file).replace("\\", r"\\"), text)
        return text


def _as_lua(text: str) -> bytes:
    return (f"--{text}" if text.startswith("#") else text).encode()  # the header


def _message(error: BaseException) -> str:
    if isinstance(error, lua54.LuaMemoryError):
        return f"not enough memory: a script in Lua may take {_MOST_MEMORY >> 20} MB"
    text = error.args[0] if error.args else ""
    if isinstance(text, bytes):
        text = text.decode(errors="backslashreplace")
    return str(text).removeprefix("error loading code: ") or "an error that is not a text"


def _no_attributes(_object: Any, name: Any, _setting: bool) -> Any:
    raise AttributeError(f"Lua does not reach into objects of Python: {name!r}")
