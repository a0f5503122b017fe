# SPDX-License-Identifier: BSD-3-Clause
"""Interface of a child script's code in any language."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any, Protocol

from bubblesim.scripting.language.python_code import PythonCode
from bubblesim.scripting.language.script_output import Source
from bubblesim.scripting.language.source import ScriptSourceError, is_lua
from bubblesim.scripting.threads.script_thread import AnyThread


class ScriptCode(Protocol):
    """Code with its own globals."""

    @property
    def is_confined(self) -> bool:
        """Return whether the language prevents access to files and processes."""

    def run(self) -> None:
        """Run the body, which defines the script's functions."""

    def execute(self, text: str) -> Any:
        """Run code with the script's globals; return the value of an expression."""

    def function(self, name: str) -> Callable[..., Any] | None:
        """Return a global of the script."""

    def functions_by_name(self) -> dict[str, str]:
        """Return the global functions of the script with FILE:LINE of each, or an empty string if unknown."""

    def make_thread(self, name: str, body: Callable[..., Any], prepare: Callable[[], object]) -> AnyThread:
        """Create the thread that calls ``prepare`` and then ``body``, a function of the script."""

    def was_interrupted(self, error: BaseException) -> bool:
        """Return whether the script failed because it was interrupted."""

    def where_now(self, thread: int) -> str:
        """Return FILE:LINE of the script that runs in another thread, or an empty string."""

    def place(self, error: BaseException) -> str:
        """Return FILE:LINE where the script failed, or an empty string."""

    def report(self, error: BaseException) -> str:
        """Return the error message and the calls."""

    def reason(self, error: BaseException) -> str:
        """Return the error message, in one line."""


def load_code(
    file: Path,
    search_paths: list[Path],
    modules: dict[str, Any],
    name: str,
    source: Source,
    *,
    lua_unsafe: bool,
    read: Callable[[Path], str],
) -> ScriptCode:
    """Compile a script without running it.

    :param name: name of the script's Python module.
    :param source: where printed lines come from.
    :param lua_unsafe: see LuaCode.
    :param read: read_text, or a function that calls it; called for each source file.
    :raises ScriptSourceError: with file and line.
    """
    text = read(file)
    if not is_lua(file, text):
        return PythonCode(file, text, search_paths, modules, name, source, read=read)
    try:
        from bubblesim.scripting.language.lua_code import LuaCode
    except ImportError as error:
        raise ScriptSourceError(
            f"{file}:1: Lua scripts need the Python package lupa ({error}): run scripts/setup, or "
            "activate a virtual environment with lupa (`pip install lupa==2.8`)"
        ) from error
    return LuaCode(file, text, search_paths, modules, source, unsafe=lua_unsafe, read=read)
