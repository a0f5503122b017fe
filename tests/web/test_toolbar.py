# SPDX-License-Identifier: BSD-3-Clause
"""The toolbar and its keys, in a real browser."""

from collections.abc import Callable
from pathlib import Path

from web_support import Node, Window

Show = Callable[..., Window]

FACTOR = "parseFloat(document.querySelector('.factor').textContent)"


def test_keys_play_pause_step_and_stop(tmp_path: Path, show: Show) -> None:
    with Node(tmp_path, "ball", "--paused") as node:
        page = show(node)
        page.page.keyboard.press("n")
        page.wait("bubblesim.link.frame.time > 0.04 && bubblesim.link.frame.state === 'paused'")
        page.page.keyboard.press("Space")
        page.wait("bubblesim.link.frame.state === 'running'")
        page.page.keyboard.press("Space")
        page.wait("bubblesim.link.frame.state === 'paused'")
        page.page.keyboard.press("Shift+Space")
        page.wait("bubblesim.link.frame.state === 'stopped' && bubblesim.link.frame.time === 0")
        assert page.page.locator(".time").inner_text() == "0.00 s"


def test_the_speed_is_that_of_the_run_and_of_all_pages(tmp_path: Path, show: Show) -> None:
    with Node(tmp_path, "ball", "--speed", "3") as node:
        first, second = show(node), show(node)
        first.wait("document.querySelector('select.speed').value === '3'")  # it is asked for after the models
        for speed, shown in (("0.5", "0.4 < f && f < 0.6"), ("2", "1.6 < f && f < 2.4"), ("0", "f > 3")):
            first.page.locator("select.speed").select_option(speed)
            second.wait("document.querySelector('select.speed').value === x", speed)
            second.wait(f"((f) => {shown})({FACTOR})")


def test_a_page_that_is_opened_later_shows_the_speed(tmp_path: Path, show: Show) -> None:
    with Node(tmp_path, "ball", "--paused") as node:
        show(node).page.locator("select.speed").select_option("0.25")
        show(node).wait("document.querySelector('select.speed').value === '0.25'")


def test_the_menu_switches_what_is_shown(tmp_path: Path, show: Show) -> None:
    with Node(tmp_path, "tricycle", "--paused") as node:
        page = show(node)
        page.page.locator("button[title='What is shown']").click()
        for title, shown in (
            ("Shadows", "bubblesim.view.lights.group.children.some((e) => e.castShadow)"),
            ("Grid", "bubblesim.view.overlays.find((e) => e.id === 'grid').layer.object3d.visible"),
        ):
            assert page.js(shown)
            page.page.locator(".menu .entry", has_text=title).click()
            page.wait(f"!{shown}")
        page.page.mouse.click(500, 500)
        assert page.page.locator(".menu").is_hidden()
        page.page.keyboard.press("x")
        page.wait("bubblesim.view.overlays.find((e) => e.id === 'frames').layer.object3d.visible")


def test_escape_closes_the_menu_and_leaves_the_selection(tmp_path: Path, show: Show) -> None:
    with Node(tmp_path, "ball", "--paused") as node:
        page = show(node)
        page.js("bubblesim.selection.select(bubblesim.scene.byPath('/Ball'))")
        page.page.click("button[title='What is shown']")
        page.wait("!document.querySelector('.menu').hidden")
        page.page.keyboard.press("Escape")
        page.wait("document.querySelector('.menu').hidden")
        assert page.js("bubblesim.selection.object.path") == "/Ball"


def test_no_button_is_cut_off_on_a_small_screen(tmp_path: Path, show: Show) -> None:
    right = "Math.max(...[...document.querySelectorAll('.toolbar button')].map((b) => b.getBoundingClientRect().right))"
    with Node(tmp_path, "tricycle", "--paused") as node:
        page = show(node)
        page.page.set_viewport_size({"width": 1024, "height": 768})
        page.wait("document.querySelector('.toolbar').clientWidth === 1024")
        assert page.js(right) <= 1024
        page.button("What is shown").click()
        assert page.js("document.querySelector('.menu').getBoundingClientRect().right") <= 1024


BACK = "getComputedStyle(document.querySelector('.toolbar')).backgroundColor"
FAINT = "getComputedStyle(document.documentElement).getPropertyValue('--faint')"
DARK, LIGHT = "rgb(34, 39, 46)", "rgb(248, 249, 251)"


def test_the_theme_is_switched_and_kept(tmp_path: Path, show: Show) -> None:
    with Node(tmp_path, "ball", "--paused") as node:
        window = show(node)
        before = window.js(BACK)
        other = {DARK: LIGHT, LIGHT: DARK}[before]
        faint = window.js(FAINT)
        assert faint.startswith("rgb"), "canvases draw with it"
        window.button("Light or dark").click()
        assert (window.js(BACK), window.js(FAINT) == faint) == (other, False)
        window.page.reload()
        window.wait(f"{BACK} === x", other)
        window.button("Light or dark").click()
        assert window.js(BACK) == before
        assert window.js("localStorage.getItem('theme')") is None, "the system's is followed again"


def test_panels_below_take_the_place_of_the_view(tmp_path: Path, show: Show) -> None:
    """Messages are seen over them."""
    height = "document.querySelector('.place.bottom').clientHeight"
    with Node(tmp_path, "ball", "--paused") as node:
        window = show(node)
        before = window.js(height)
        window.button("Maximise").click()
        assert window.js(height) > before + 200
        assert window.page.locator(".view").is_hidden()
        window.js("bubblesim.notify('seen', 'error')")
        notice = window.page.locator(".notice")
        notice.click()  # which needs it to be on top
        assert notice.count() == 0
        window.page.locator(".place.bottom .tab").first.dblclick()
        assert window.js(height) == before
        window.js("bubblesim.view.settled()")
        assert window.page.locator(".view").is_visible()
