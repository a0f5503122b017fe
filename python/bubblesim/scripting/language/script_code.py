# SPDX-License-Identifier: BSD-3-Clause
"""A child script's code, whichever language it is written in."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any, Protocol

from bubblesim.scripting.language.python_code import PythonCode
from bubblesim.scripting.language.source import ScriptSourceError, is_lua, read_text
from bubblesim.scripting.threads.script_thread import AnyThread


class ScriptCode(Protocol):
    """Code with globals of its own."""

    @property
    def files(self) -> set[Path]:
        """What it was read from so far."""

    @property
    def is_confined(self) -> bool:
        """Whether its language keeps it from files and processes."""

    def run(self) -> None:
        """Run the body, which defines the script's functions."""

    def function(self, name: str) -> Callable[..., Any] | None:
        """Find what the script has under a global name."""

    def functions_by_name(self) -> dict[str, str]:
        """The global functions of the script, and FILE:LINE of each, or nothing where that is not known."""

    def make_thread(self, name: str, body: Callable[..., Any], prepare: Callable[[], object]) -> AnyThread:
        """Make the thread that runs ``body``, a function of the script, after ``prepare``, which is none."""

    def broken_off(self, error: BaseException) -> bool:
        """Whether the script failed for it was interrupted."""

    def where_now(self, thread: int) -> str:
        """FILE:LINE where the script is that runs in another thread, or nothing."""

    def place(self, error: BaseException) -> str:
        """FILE:LINE where the script failed, or nothing."""

    def report(self, error: BaseException) -> str:
        """What went wrong, and the calls that led there."""

    def reason(self, error: BaseException) -> str:
        """What went wrong, in one line."""


def load_code(
    file: Path,
    search_paths: list[Path],
    modules: dict[str, Any],
    name: str,
    prefix: Callable[[], str],
    *,
    lua_unsafe: bool,
) -> ScriptCode:
    """Compile a script without running it.

    :param name: of the Python module that the script becomes.
    :param prefix: of the lines that it prints.
    :param lua_unsafe: see LuaCode.
    :raises ScriptSourceError: naming file and line.
    """
    text = read_text(file)
    if not is_lua(file, text):
        return PythonCode(file, text, search_paths, modules, name, prefix)
    try:
        from bubblesim.scripting.language.lua_code import LuaCode
    except ImportError as error:
        raise ScriptSourceError(
            f"{file}:1: is a Lua script, and these need the Python package lupa ({error}): run scripts/setup, or "
            "activate a virtual environment in which `pip install lupa==2.8` was done"
        ) from error
    return LuaCode(file, text, search_paths, modules, prefix, unsafe=lua_unsafe)
