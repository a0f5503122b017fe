# SPDX-License-Identifier: BSD-3-Clause
"""What the window shows can be read and seen, in both colour schemes."""

import io
from pathlib import Path

import pytest

pytest.importorskip("playwright")

from PIL import Image
from playwright.sync_api import Browser

from web_support import TIMEOUT, Node, Window, new_page

LEAST = 4.5
"""Contrast of strings, WCAG 2.1, success criterion 1.4.3; buttons that are disabled are exempt."""
_FAINT_TEXTS = """(() => {
  const numbers = (color) => color.match(/[0-9.]+/g).map(Number);
  const luminance = (color) => {
    const parts = color.map((each) => each / 255).map((v) => (v <= 0.03928 ? v / 12.92 : ((v + 0.055) / 1.055) ** 2.4));
    return 0.2126 * parts[0] + 0.7152 * parts[1] + 0.0722 * parts[2];
  };
  const over = ([r, g, b, alpha = 1], below) => [r, g, b].map((each, i) => each * alpha + below[i] * (1 - alpha));
  const background = (element) =>
    element ? over(numbers(getComputedStyle(element).backgroundColor), background(element.parentElement)) : [0, 0, 0];
  const found = [];
  for (const element of document.querySelectorAll("body *:not(option)")) {
    const text = [...element.childNodes].filter((each) => each.nodeType === Node.TEXT_NODE).map((each) => each.data);
    const shown = text.join("").trim() || element.placeholder;
    if (!shown || !element.checkVisibility({ visibilityProperty: true }) || element.closest(":disabled")) continue;
    const style = getComputedStyle(element, text.join("").trim() ? null : "::placeholder");
    const back = background(element);
    const levels = [luminance(over(numbers(style.color), back)), luminance(back)].sort((a, b) => b - a);
    const contrast = (levels[0] + 0.05) / (levels[1] + 0.05);
    if (contrast < x) found.push(`${shown.slice(0, 40)}: ${contrast.toFixed(2)}`);
  }
  return found;
})()"""
TABS = [
    "Models",
    "Build",
    "Scripts",
    "Plots",
    "Cameras",
    "Problems",
    "Drive",
    "Record",
    "Console",
    "Scene",
    "Properties",
]


@pytest.mark.parametrize("scheme", ["light", "dark"])
def test_all_texts_have_enough_contrast(tmp_path: Path, browser: Browser, scheme: str) -> None:
    with Node(tmp_path, "tricycle", "--paused") as node:
        page = browser.new_context(viewport={"width": 1280, "height": 800}, color_scheme=scheme).new_page()  # type: ignore[arg-type]
        page.set_default_timeout(TIMEOUT)
        window = Window(page, node.address)
        node.windows.append(window)
        window.js("bubblesim.layout.showFor({ ros: true })")  # also the tabs that need it
        faint = set()
        for tab in TABS:
            page.locator(".tab", has_text=tab).click()
            faint |= set(window.js(_FAINT_TEXTS, LEAST))
        for path in ("/Tricycle", "/Tricycle/base_link/Camera", "/Tricycle/Steering"):
            window.select(path)
            page.wait_for_timeout(300)
            faint |= set(window.js(_FAINT_TEXTS, LEAST))
        window.button("What is shown").click()
        faint |= set(window.js(_FAINT_TEXTS, LEAST))
        page.keyboard.press("Escape")
        for _ in range(2):  # frames of a run
            time = window.js("bubblesim.link.frame.time")
            page.keyboard.press("n")
            window.wait("bubblesim.link.frame.time > x", time)
        page.keyboard.press("l")
        window.wait("bubblesim.playback.run !== null")
        window.js("bubblesim.layout.show('record')")  # the properties are greyed, as what is disabled
        faint |= set(window.js(_FAINT_TEXTS, LEAST))
        page.click("button:has-text('Video…')")
        faint |= set(window.js(_FAINT_TEXTS, LEAST))
        page.keyboard.press("Escape")
        page.keyboard.press("l")
        window.js("bubblesim.link.emit('gone')")
        faint |= set(window.js(_FAINT_TEXTS, LEAST))
        assert faint == set()
        assert window.errors == []


def test_lines_of_the_grid_that_lead_behind_the_camera_are_drawn(tmp_path: Path, browser: Browser) -> None:
    """The scene is small: the red axis ends far behind the camera."""
    with Node(tmp_path, "ball", "--paused") as node:
        window = Window(new_page(browser, 1000, 620, scale=1.0), node.address)
        node.windows.append(window)
        canvas = Image.open(io.BytesIO(window.page.locator(".view canvas").screenshot(timeout=TIMEOUT)))
        reds = sum(1 for r, g, b in canvas.convert("RGB").getdata() if r > g + 40 and r > b + 40)
        assert reds > 30
