# SPDX-License-Identifier: BSD-3-Clause
"""Writes the reference page of the kinds of sensors: ``python -m bubblesim.scene_files.sensor_kinds``."""

from __future__ import annotations

import sys
from collections.abc import Iterator
from typing import Any

from bubblesim._core import sensor_kinds
from bubblesim.scene_files.reference_page import markdown_table, print_page

_INTRODUCTION = """\
# Kinds of sensors

<!-- Generated from the members of the kinds by `python -m bubblesim.scene_files.sensor_kinds`. -->

What each kind of sensor has: the values that it takes from the scene file, those of its readings (properties of the
class in Python, members of the struct in C++), and the [quantities](many_worlds.md) of batches. [Sensors](sensors.md)
explains them with examples, [elements](worlds/elements.md) lists the elements of scene files. Each reading also has
`time`, the simulated seconds of the state that it shows.
"""


def page() -> str:
    """Return the page as Markdown: a section for each kind, one for the structs that several have."""
    parts = [_INTRODUCTION]
    shared: dict[str, dict[str, Any]] = {}
    for kind in sensor_kinds():
        parts += _section(kind)
        for table in (kind["description"], kind["reading"]):
            shared.update((part["name"], part) for part in _below(table))
    for name in sorted(shared):
        parts += [f"## {name}\n", f"{shared[name]['doc']}\n", _members(shared[name])]
    return "\n".join(parts)


def _section(kind: dict[str, Any]) -> Iterator[str]:
    yield f"## {kind['name'][0].upper()}{kind['name'][1:]}\n"
    types = ", ".join(f"`{name}`" for name in kind["types"])
    place = "a `<joint>`" if kind["of_joint"] else "a `<link>`"
    yield f"{kind['description']['doc']} `<sensor type>`: {types}, in {place}.\n"
    yield _members(kind["description"])
    yield f"`bubblesim.{kind['reading']['name']}`: {kind['reading']['doc']}\n"
    yield _members(kind["reading"])
    if kind["quantities"]:
        yield markdown_table(
            ("Quantity", "Unit", "Meaning"), ([f"`{q['name']}`", q["unit"], q["doc"]] for q in kind["quantities"])
        )


def _below(table: dict[str, Any]) -> Iterator[dict[str, Any]]:
    for part in table["parts"]:
        yield part
        yield from _below(part)


def _members(table: dict[str, Any]) -> str:
    def meaning(member: dict[str, Any]) -> str:
        return f"{member['doc']}; {member['limits']}" if member["limits"] else str(member["doc"])

    rows = ([f"`{each['name']}`", each["type"], each["unit"], meaning(each)] for each in table["members"])
    return markdown_table(("Member", "Type", "Unit", "Meaning"), rows)


def main() -> int:
    """Print the page."""
    return print_page("bubblesim.scene_files.sensor_kinds", page)


if __name__ == "__main__":
    sys.exit(main())
