# SPDX-License-Identifier: BSD-3-Clause
"""The reference page of the kinds of sensors."""

from __future__ import annotations

from pathlib import Path

from bubblesim._core import sensor_kinds

import bubblesim
from bubblesim.scene_files.sensor_kinds import page

PAGE = Path(__file__).parents[2] / "docs/sensor_kinds.md"


def test_the_page_is_that_of_the_kinds() -> None:
    assert PAGE.read_text() == page(), "renew it: python -m bubblesim.scene_files.sensor_kinds > docs/sensor_kinds.md"


def test_each_kind_has_a_class_in_the_package() -> None:
    for kind in sensor_kinds():
        reading = getattr(bubblesim, kind["reading"]["name"])
        members = {member["name"] for member in kind["reading"]["members"]}
        assert members | {"time"} == {name for name in dir(reading) if not name.startswith("_")} - {"fill_cloud"}
