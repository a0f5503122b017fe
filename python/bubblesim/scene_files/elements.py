# SPDX-License-Identifier: BSD-3-Clause
"""Writes the reference page of the elements of scene files: ``python -m bubblesim.scene_files.elements``."""

from __future__ import annotations

import sys
from collections.abc import Iterable

from bubblesim._core import SceneElement, scene_elements

_INTRODUCTION = """\
# Elements of scene files

<!-- Generated from the table of elements by `python -m bubblesim.scene_files.elements`. -->

All elements of [SDFormat](http://sdformat.org/spec) 1.0 to 1.12 and those of bubblesim, with types and defaults. Files
of older versions are read by the rules of the specification for newer ones. What several elements have in common, such
as a geometry or a pose, is listed below the first of them. Vectors are numbers separated by spaces; poses are x y z
roll pitch yaw in metres and radians.

`bubblesim check FILE` lists what a file has of the elements that are left out.
"""

_TYPES = {"none": "", "any": "any content"}


def page() -> str:
    """Return the page as Markdown: a table of the elements that are read, one of those that are not."""
    elements = scene_elements()
    parts = [
        _INTRODUCTION,
        "## Read\n",
        _table(
            ("Element", "Type", "Default"),
            ([_code(e.path), _TYPES.get(e.type, e.type), e.default_text] for e in _with(elements, "read")),
        ),
        "## Left out, with a warning\n",
        _table(("Element", "Reason"), ([_code(e.path), e.reason] for e in _with(elements, "left out"))),
        "## Without effect\n",
        _table(("Element", "Reason"), ([_code(e.path), e.reason] for e in _with(elements, "none"))),
    ]
    return "\n".join(parts)


def _with(elements: list[SceneElement], effect: str) -> list[SceneElement]:
    return [element for element in elements if element.effect == effect]


def _code(path: str) -> str:
    return f"`{path}`"


def _table(head: tuple[str, ...], rows: Iterable[list[str]]) -> str:
    lines: list[Iterable[str]] = [head, ["---"] * len(head), *rows]
    return "\n".join("| " + " | ".join(cells) + " |" for cells in lines) + "\n"


def main() -> int:
    """Print the page."""
    if len(sys.argv) != 1:
        print("usage: python -m bubblesim.scene_files.elements", file=sys.stderr)
        return 2
    print(page(), end="")
    return 0


if __name__ == "__main__":
    sys.exit(main())
