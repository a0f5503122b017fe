# SPDX-License-Identifier: BSD-3-Clause
"""A node with its window, and pages in a real browser."""

import os
import re
import time
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any, Self

import pytest
from playwright.sync_api import Browser, ConsoleMessage, Page, Playwright, sync_playwright

from ros_support import DEADLINE, built, start, stop, until_next_look, wait_until

# Without --disable-gpu-compositing the whole page is drawn by the software GL, at twice the time.
_FLAGS = ["--use-angle=swiftshader", "--enable-unsafe-swiftshader", "--disable-gpu-compositing", "--no-sandbox"]
TOKEN = {"BUBBLESIM_WEB_TOKEN": "t"}  # for the environment of a node or server
TIMEOUT = 3000 * DEADLINE  # ms, for a busy machine that draws without a GPU


def launch_browser(playwright: Playwright) -> Browser:
    """Start Debian's Chromium, which draws in software."""
    return playwright.chromium.launch(executable_path="/usr/bin/chromium-headless-shell", args=_FLAGS, timeout=TIMEOUT)


def new_page(browser: Browser, width: int, height: int, *, scale: float = 0.5, first_visit: bool = False) -> Page:
    """Open an empty page of its own session, in CSS pixels.

    `scale` 0.5 draws a quarter as many, for the sake of time. Only a `first_visit` shows the line with the first steps.
    """
    page = browser.new_context(viewport={"width": width, "height": height}, device_scale_factor=scale).new_page()
    page.set_default_timeout(TIMEOUT)
    if not first_visit:
        page.add_init_script("localStorage.setItem('first-steps', 'known')")
    return page


class Node:
    """A node without ROS that shows a window."""

    def __init__(self, folder: Path, scene: str, *options: str) -> None:
        """Start it, and wait for the address of the window."""
        self.windows: list[Window] = []
        self._log = folder / "node.err"
        self._errors = self._log.open("w")
        command = [str(built("sim")), scene, "--no-ros", "--web", *options]
        self._output = (folder / "node.out").open("w")
        self.process = start(command, os.environ | TOKEN, stdout=self._output, stderr=self._errors)
        try:
            self.origin = self.find(r"the window is at (\S+)/\s")
        except BaseException:
            self.__exit__()
            raise
        self.address = f"{self.origin}/#token=t"

    def find(self, pattern: str) -> str:
        """Return the first group of the pattern as soon as the node's errors have it."""
        found: list[str] = []

        def look() -> bool:
            # Not through the handle that the node writes to: it has one position for both.
            found[:] = re.findall(pattern, self._log.read_text())
            return bool(found)

        wait_until(look, f"{pattern} in the node's output", timeout=TIMEOUT / 1000)
        return found[0]

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *_error: object) -> None:
        for window in self.windows:  # a page that outlives the server reports that it is gone
            window.close()
        stop(self.process)
        self._errors.close()
        self._output.close()


_IS_LOOKED_AT = """((object) => {
  const { camera, controls } = bubblesim.view.viewpoint;
  const { centre, radius } = bubblesim.view.extent(object);
  const distance = camera.position.distanceTo(controls.target) / Math.max(2.6 * radius, 0.3);
  return controls.target.distanceTo(centre) < 1e-3 && Math.abs(distance - 1) < 1e-3;
})(bubblesim.scene.byPath(x))"""
_DIFFERENT_PIXELS = """(async () => {
  const a = bubblesim;
  await a.view.settled();
  const sensor = [...a.scene.objects.values()].find((e) => e.parameters?.kind === "camera");
  const seen = a.view.pictureFrom(sensor);
  const { rgb } = await a.link.call("window.reading", [sensor.handle]);
  let pixels = 0;
  for (let i = 0; i < seen.width * seen.height; ++i) {
    if ([0, 1, 2].some((c) => Math.abs(seen.rgba[4 * i + c] - rgb[3 * i + c]) > 40)) ++pixels;
  }
  return pixels / (seen.width * seen.height);
})()"""


class Window:
    """A page that shows the scene."""

    def __init__(self, page: Page, address: str) -> None:
        """Open it and wait until the scene is drawn."""
        self.page = page
        self.errors: list[str] = []
        self.may_lose_server = False
        """The server ends before the page: errors of the connection to it are expected."""
        page.on("pageerror", lambda error: self.errors.append(str(error)))
        page.on("console", self._note)
        page.goto(address)
        self.wait("bubblesim.scene.models.length > 0 && bubblesim.link.frame")
        self.js("bubblesim.view.settled()")

    def _note(self, message: ConsoleMessage) -> None:
        refused = message.text.startswith("WebSocket connection to")
        if message.type == "error" and not (refused and self.may_lose_server):
            self.errors.append(message.text)

    def close(self) -> None:
        """Close the page, and its session."""
        self.page.context.close()

    def js(self, expression: str, argument: Any = None) -> Any:
        """Return the value of an expression; `x` is the argument."""
        return self.page.evaluate(f"x => ({expression})", argument)

    def wait(self, condition: str, argument: Any = None) -> None:
        """Wait until an expression is true."""
        # Not wait_for_function: it evaluates strings in the page, which the page's own policy forbids.
        begin = time.monotonic()
        while not self.page.evaluate(f"x => Boolean({condition})", argument):
            waited = time.monotonic() - begin
            assert waited < TIMEOUT / 1000, f"{condition}; errors of the page: {self.errors}"
            self.page.wait_for_timeout(1000 * until_next_look(waited))

    def difference_from_camera(self) -> float:
        """Return the share of pixels that differ from the simulator's picture of the first camera."""
        return float(self.js(_DIFFERENT_PIXELS))

    def call(self, function: str, *arguments: Any) -> Any:
        """Call a function of the simulator as the page does."""
        return self.page.evaluate("([name, args]) => bubblesim.link.call(name, args)", [function, list(arguments)])

    def select(self, path: str) -> None:
        """Select an object."""
        self.js("bubblesim.selection.select(bubblesim.scene.byPath(x))", path)

    def middle(self) -> list[float]:
        """Return the middle of the 3D view on the screen."""
        box = self.page.locator(".view canvas").bounding_box()
        assert box
        return [box["x"] + box["width"] / 2, box["y"] + box["height"] / 2]

    def is_near(self, path: str) -> None:
        """Wait until the camera shows an object from near."""
        self.wait(_IS_LOOKED_AT, path)

    def look_at(self, path: str) -> None:
        """Show an object from near."""
        self.js("bubblesim.view.viewpoint.look(bubblesim.scene.byPath(x))", path)
        self.is_near(path)

    def zoom_out(self, factor: float) -> None:
        """Turn the wheel in the middle until the camera is at least this many times as far away."""
        distance = "bubblesim.view.camera.position.distanceTo(bubblesim.view.viewpoint.controls.target)"
        end = factor * self.js(distance)
        self.page.mouse.move(*self.middle())
        while self.js(distance) < end:
            self.page.mouse.wheel(0, 400)
            self.page.wait_for_timeout(50)

    def look_from_above(self) -> None:
        """Look down at what is in the middle."""
        self.js("bubblesim.view.viewpoint.lookFrom('top')")
        away = "bubblesim.view.camera.position.clone().sub(bubblesim.view.viewpoint.controls.target).normalize()"
        self.wait(f"{away}.z > 0.9999999")

    def open_file(self, file: Path) -> None:
        """Choose a file in the window's dialog."""
        with self.page.expect_file_chooser() as chooser:
            self.js("0")  # an answer comes when the browser has been told to report what it asks for
            self.button("Open a recorded run").click()
        chooser.value.set_files(file)

    def button(self, title: str) -> Any:
        """Return the button whose title begins so."""
        return self.page.locator(f"button[title^='{title}']")


@pytest.fixture(scope="module")
def browser() -> Iterator[Browser]:
    """The browser of a file's tests."""
    with sync_playwright() as playwright:
        chromium = launch_browser(playwright)
        yield chromium
        chromium.close()


@pytest.fixture
def show(browser: Browser) -> Iterator[Callable[..., Window]]:
    """Open pages; at the end there must be no errors in their consoles."""
    windows: list[Window] = []

    def open_page(node: Node | str) -> Window:
        page = new_page(browser, 1000, 620)
        window = Window(page, node if isinstance(node, str) else node.address)
        windows.append(window)
        if isinstance(node, Node):
            node.windows.append(window)
        return window

    yield open_page
    for window in windows:
        window.close()
        assert window.errors == []
