# SPDX-License-Identifier: BSD-3-Clause
"""The line of a first visit, and the list of keys."""

from collections.abc import Callable, Iterator
from pathlib import Path

import pytest
from playwright.sync_api import Browser

from web_support import Node, Window, new_page


@pytest.fixture
def first_visit(browser: Browser, tmp_path: Path) -> Iterator[Window]:
    """A window that is opened for the first time."""
    with Node(tmp_path, "ball", "--paused") as node:
        window = Window(new_page(browser, 1000, 620, first_visit=True), node.address)
        node.windows.append(window)
        yield window
        assert window.errors == []


def test_the_line_comes_until_it_is_closed(first_visit: Window) -> None:
    page = first_visit.page
    for _ in range(2):
        assert "turns the view" in page.locator(".first-steps").inner_text()
        page.reload()
        first_visit.wait("bubblesim.link.frame")
    page.locator(".first-steps button").click()
    assert page.locator(".first-steps").count() == 0
    page.reload()
    first_visit.wait("bubblesim.link.frame")
    assert page.locator(".first-steps").count() == 0


def test_the_view_turns_below_the_line(first_visit: Window) -> None:
    page = first_visit.page
    box = page.locator(".first-steps p").bounding_box()
    assert box
    place = "bubblesim.view.viewpoint.camera.position.toArray()"
    before = first_visit.js(place)
    page.mouse.move(box["x"] + 20, box["y"] + 20)
    page.mouse.down()
    page.mouse.move(box["x"] + 80, box["y"] + 20, steps=4)
    page.mouse.up()
    first_visit.wait(f"{place}.some((each, axis) => Math.abs(each - x[axis]) > 0.1)", before)


def test_a_question_mark_lists_the_keys(tmp_path: Path, show: Callable[..., Window]) -> None:
    with Node(tmp_path, "ball", "--paused") as node:
        page = show(node).page
        page.keyboard.press("?")
        assert "play, pause" in page.locator("dialog.about").inner_text()
        page.keyboard.press("Escape")
        page.locator("dialog.about").wait_for(state="detached")
