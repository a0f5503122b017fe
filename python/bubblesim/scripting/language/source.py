# SPDX-License-Identifier: BSD-3-Clause
"""Reads the source files of child scripts."""

from __future__ import annotations

from pathlib import Path

_OTHER_LANGUAGES = {
    ".js": "JavaScript",
    ".ts": "TypeScript",
    ".m": "MATLAB",
    ".c": "C",
    ".cpp": "C++",
    ".java": "Java",
    ".rb": "Ruby",
    ".sh": "a shell script",
}


class ScriptSourceError(Exception):
    """A script that cannot be loaded; the text states file and line."""


def read_text(file: Path) -> str:
    """Read a script's file.

    :raises ScriptSourceError: if that fails.
    """
    try:
        return file.read_text(encoding="utf-8-sig")
    except (OSError, UnicodeDecodeError) as error:
        raise ScriptSourceError(f"{file}: cannot be read: {error}") from error


def find_file(name: str, folders: list[Path], *, but_not: Path | None = None) -> Path:
    """Find a file that a script includes or requires.

    :param but_not: a file that is not meant.
    :raises ScriptSourceError: if no folder contains it.
    """
    for folder in folders:
        file = folder / name
        if file.is_file() and file != but_not:
            return file
    searched = ", ".join(str(folder) for folder in folders)
    raise ScriptSourceError(f"file not found: {name} in {searched}; add its folder with --script-path")


def is_lua(file: Path, text: str) -> bool:
    """Return whether a script is written in Lua: by its first line, `#lua` or `#python`, or its extension, `.lua`.

    :raises ScriptSourceError: if the extension is that of another language, and no first line names one of these two.
    """
    first = text.partition("\n")[0].strip()
    if first not in ("#lua", "#python") and file.suffix in _OTHER_LANGUAGES:
        raise ScriptSourceError(
            f"{file}:1: {_OTHER_LANGUAGES[file.suffix]} does not run here: scripts are written in Python (.py) or Lua "
            "(.lua); the first line #python or #lua names the language of a file with another extension"
        )
    return first == "#lua" or (file.suffix == ".lua" and first != "#python")
