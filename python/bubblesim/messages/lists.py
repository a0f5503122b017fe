# SPDX-License-Identifier: BSD-3-Clause
"""The lists of types that a build compiles: meta/messages.txt and meta/services.txt."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

from bubblesim.messages.names import split_name, type_name


@dataclass(frozen=True)
class Entry:
    """A line of a list that contains a type."""

    place: str  # "meta/messages.txt:12"
    name: str  # "geometry_msgs/Twist"
    is_service: bool = False  # listed as package/srv/Type


def read_list(path: Path, shown_as: str, problems: list[str], warnings: list[str]) -> list[Entry]:
    """Return the entries of a list file; add malformed lines to `problems`, duplicates to `warnings`."""
    entries: dict[str, Entry] = {}
    # A byte that is not UTF-8 is no part of a type's name; in a comment it does not matter.
    for number, line in enumerate(path.read_text(encoding="utf-8", errors="replace").splitlines(), start=1):
        text = _content(line)
        if not text:
            continue
        place = f"{shown_as}:{number}"
        name = type_name(text)
        if name is None:
            problems.append(f"{place}: '{text}' is not a type name, expected package/Type such as geometry_msgs/Twist")
        elif name in entries:
            warnings.append(f"{place}: {name} is listed twice, first at {entries[name].place}; the first line counts")
        else:
            entries[name] = Entry(place, name, "/srv/" in text)
    return list(entries.values())


def read_interfaces(
    path: Path, shown_as: str, problems: list[str], warnings: list[str]
) -> tuple[list[Entry], list[Entry]]:
    """Return the messages and services of a list that has both, in ROS 2's spelling; nothing without the file."""
    entries = read_list(path, shown_as, problems, warnings) if path.is_file() else []
    return [entry for entry in entries if not entry.is_service], [entry for entry in entries if entry.is_service]


def add_to_list(path: Path, name: str) -> str:
    """Write a type into messages.txt or services.txt, sorted within its package; return a message about the change."""
    lines = path.read_text(encoding="utf-8").splitlines()
    package = split_name(name)[0]
    place = None  # index of the new line
    for index, line in enumerate(lines):
        listed = type_name(_content(line)) or ""
        if listed == name:
            return f"{name}: already listed at {path}:{index + 1}"
        if split_name(listed)[0] == package and (place is None or listed < name):
            place = index + 1 if listed < name else index
    if place is None:
        if lines and lines[-1].strip():
            lines.append("")
        place = len(lines)
    lines.insert(place, name)
    path.write_text("\n".join(lines) + "\n", encoding="utf-8")
    return f"{name}: listed at {path}:{place + 1}"


def _content(line: str) -> str:
    return line.partition("#")[0].strip()
