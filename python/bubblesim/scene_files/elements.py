# SPDX-License-Identifier: BSD-3-Clause
"""Writes the reference page of the elements of scene files: ``python -m bubblesim.scene_files.elements``."""

from __future__ import annotations

import sys

from bubblesim._core import SceneElement, scene_elements
from bubblesim.scene_files.reference_page import markdown_table, print_page

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
        markdown_table(
            ("Element", "Type", "Default"),
            ([_code(e.path), _TYPES.get(e.type, e.type), e.default_text] for e in _with(elements, "read")),
        ),
        "## Left out, with a warning\n",
        markdown_table(("Element", "Reason"), ([_code(e.path), e.reason] for e in _with(elements, "left out"))),
        "## Without effect\n",
        markdown_table(("Element", "Reason"), ([_code(e.path), e.reason] for e in _with(elements, "none"))),
    ]
    return "\n".join(parts)


def _with(elements: list[SceneElement], effect: str) -> list[SceneElement]:
    return [element for element in elements if element.effect == effect]


def _code(path: str) -> str:
    return f"`{path}`"


def main() -> int:
    """Print the page."""
    return print_page("bubblesim.scene_files.elements", page)


if __name__ == "__main__":
    sys.exit(main())
