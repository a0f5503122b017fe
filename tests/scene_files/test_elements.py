# SPDX-License-Identifier: BSD-3-Clause
"""The reference page of the elements of scene files."""

from __future__ import annotations

from pathlib import Path

from bubblesim.scene_files.elements import page

PAGE = Path(__file__).parents[2] / "docs/worlds/elements.md"


def test_the_page_is_that_of_the_table() -> None:
    assert PAGE.read_text() == page(), "renew it: python -m bubblesim.scene_files.elements > docs/worlds/elements.md"
