# SPDX-License-Identifier: BSD-3-Clause
"""Warnings and errors as values with their place, for readers such as the window."""

from __future__ import annotations

import re
from dataclasses import dataclass

_PLACED = re.compile(r"(?P<file>/[^:\n]*):(?P<line>\d+): (?P<text>.*)", re.DOTALL)
_OF_SCENE = re.compile(r"(?P<file>[^:]*?)(?::(?P<line>\d+))?: (?:(?P<object>/\S*): )?(?P<text>.*)", re.DOTALL)


@dataclass(frozen=True)
class Problem:
    """What is wrong, and where."""

    source: str
    """'scene' or 'script'."""
    level: str
    """'error' or 'warning'."""
    object: str
    """Path of an object, or empty."""
    file: str
    """Absolute path, or empty."""
    line: int
    """0 if unknown."""
    text: str


def of_scene(warning: str) -> Problem:
    """Return a warning of a scene's file, 'FILE:LINE: OBJECT: TEXT', as a value."""
    found = _OF_SCENE.fullmatch(warning)
    if found is None:
        return Problem("scene", "warning", "", "", 0, warning)
    return Problem(
        "scene", "warning", found["object"] or "", found["file"], int(found["line"] or 0), found["text"].strip()
    )


def of_script(level: str, path: str, file: str, place: str, text: str) -> Problem:
    """Return a problem of the script of an object.

    :param place: FILE:LINE, or an empty string if only the ``file`` is known.
    """
    known, _, line = place.rpartition(":")
    return Problem("script", level, path, known or file, int(line) if line.isdigit() else 0, text)


def of_source(path: str, file: str, text: str) -> Problem:
    """Return a problem of a script that cannot be loaded, whose text may begin with FILE:LINE."""
    found = _PLACED.fullmatch(text)
    if found is None:
        return Problem("script", "error", path, file, 0, text)
    return Problem("script", "error", path, found["file"], int(found["line"]), found["text"])
