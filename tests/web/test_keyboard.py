# SPDX-License-Identifier: BSD-3-Clause
"""What can be done without a mouse, in a real browser."""

from collections.abc import Callable
from pathlib import Path

import pytest

from ros_support import stop
from web_support import Node, Window

Show = Callable[..., Window]


@pytest.mark.parametrize(
    ("place", "grows", "shrinks", "side"),
    [
        ("left", "ArrowRight", "ArrowLeft", "width"),
        ("right", "ArrowLeft", "ArrowRight", "width"),
        ("bottom", "ArrowUp", "ArrowDown", "height"),
    ],
)
def test_the_borders_of_panels_move_by_arrow_keys(
    tmp_path: Path, show: Show, place: str, grows: str, shrinks: str, side: str
) -> None:
    size = f"Math.round(document.querySelector('.place.{place}').getBoundingClientRect().{side})"
    name = "below" if place == "bottom" else f"at the {place}"
    with Node(tmp_path, "ball", "--paused") as node:
        page = show(node)
        before = page.js(size)
        border = page.page.locator(f"[role=separator][aria-label='Size of the panels {name}']")
        border.press(grows)
        assert page.js(size) == before + 20
        border.press(shrinks)
        assert page.js(size) == before


def test_a_model_and_a_part_are_added_by_enter(tmp_path: Path, show: Show) -> None:
    with Node(tmp_path, "ball", "--paused") as node:
        page = show(node)
        page.js("bubblesim.layout.show('models')")
        page.page.locator("[data-model=chair]").press("Enter")
        page.wait("bubblesim.scene.byPath('/chair')")
        page.js("bubblesim.layout.show('build')")
        page.page.locator(".part:text-is('Cone')").press("Enter")
        page.wait("bubblesim.scene.byPath('/Cone')")


def test_the_space_bar_presses_the_button_that_tab_has_reached(tmp_path: Path, show: Show) -> None:
    with Node(tmp_path, "ball", "--paused") as node:
        page = show(node)
        page.js("bubblesim.layout.show('build')")
        page.page.locator(".part:text-is('Box')").focus()
        page.page.keyboard.press("Tab")
        page.page.keyboard.press("Space")
        page.wait("bubblesim.scene.byPath('/Sphere')")
        assert page.js("bubblesim.link.frame.state") != "running"


def test_after_the_end_of_the_simulator_the_last_picture_is_grey(tmp_path: Path, show: Show) -> None:
    with Node(tmp_path, "ball") as node:
        page = show(node)
        page.wait("document.querySelector('.toolbar .state').textContent === 'running'")
        page.may_lose_server = True
        stop(node.process)
        page.wait("document.querySelector('.toolbar .state').textContent === 'ended'")
        assert "grayscale" in page.js("getComputedStyle(document.querySelector('.view')).filter")
        assert page.page.locator(".lost").is_visible()
        page.page.keyboard.press("l")  # what was recorded can still be played
        page.wait("bubblesim.playback.run !== null")
        assert page.js("getComputedStyle(document.querySelector('.view')).filter") == "none"


def test_control_o_asks_for_a_file(tmp_path: Path, show: Show) -> None:
    with Node(tmp_path, "ball", "--paused") as node:
        page = show(node)
        page.page.mouse.click(*page.middle())  # browsers ask for files only after a user has done something
        with page.page.expect_file_chooser() as chooser:
            page.js("0")  # an answer comes when the browser has been told to report what it asks for
            page.page.keyboard.press("Control+o")
        assert not chooser.value.is_multiple()
