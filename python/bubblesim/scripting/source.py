# SPDX-License-Identifier: BSD-3-Clause
"""Reads a child script's file: its language, the files it includes, its code."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from types import CodeType


class ScriptSourceError(Exception):
    """A script that cannot be loaded; the text names file and line."""


@dataclass(frozen=True)
class ScriptSource:
    """A script's code, the included files' first."""

    file: Path
    parts: list[CodeType]


def load_source(file: Path, search_paths: list[Path]) -> ScriptSource:
    """Compile a script and the files that its header includes.

    The first line may be ``#python``; the lines below it may be ``include NAME`` (no quotes, no extension), which is
    looked for in the script's folder and then in ``search_paths``.

    :raises ScriptSourceError: for another language, a missing file or a syntax error.
    """
    return ScriptSource(file, _compile(file, [file.parent, *search_paths], including=()))


def _compile(file: Path, folders: list[Path], including: tuple[Path, ...]) -> list[CodeType]:
    file = file.resolve()
    if file in including:
        raise ScriptSourceError(f"{file}: includes itself through {including[-1]}")
    try:
        lines = file.read_text(encoding="utf-8-sig").splitlines(keepends=True)
    except (OSError, UnicodeDecodeError) as error:
        raise ScriptSourceError(f"{file}: cannot be read: {error}") from error
    _check_language(file, lines)

    parts: list[CodeType] = []
    for number, line in enumerate(lines):
        words = line.split()
        if len(words) == 2 and words[0] == "include":
            included = _find(words[1], folders, f"{file}:{number + 1}")
            parts += _compile(included, folders, (*including, file))
            lines[number] = "\n"  # keeps the numbers of the lines below
        elif words and not line.startswith("#"):
            break  # the header ends where the code starts
    try:
        # A script does not inherit this file's __future__ imports.
        parts.append(compile("".join(lines), str(file), "exec", dont_inherit=True))
    except SyntaxError as error:
        place = f"{error.filename or file}:{error.lineno or 1}"
        shown = f"\n    {error.text.strip()}" if error.text else ""
        raise ScriptSourceError(f"{place}: {type(error).__name__}: {error.msg}{shown}") from error
    except (ValueError, RecursionError, MemoryError) as error:
        raise ScriptSourceError(f"{file}:1: {error}") from error
    return parts


def _check_language(file: Path, lines: list[str]) -> None:
    first = lines[0].strip() if lines else ""
    if first == "#lua" or (file.suffix == ".lua" and first != "#python"):
        raise ScriptSourceError(f"{file}:1: is a Lua script; child scripts are written in Python")


def _find(name: str, folders: list[Path], where: str) -> Path:
    for folder in folders:
        file = folder / f"{name}.py"
        if file.is_file():
            return file
    searched = ", ".join(str(folder) for folder in folders)
    raise ScriptSourceError(f"{where}: no file {name}.py to include in {searched}; add its folder with --script-path")
