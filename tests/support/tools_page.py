# SPDX-License-Identifier: BSD-3-Clause
"""A node with a remote API, the server of the window, and a page in a real browser; everything ends with the block."""

import subprocess
import sys
from collections.abc import Mapping
from contextlib import ExitStack
from pathlib import Path
from types import TracebackType
from typing import Any, Self

from playwright.sync_api import Page, sync_playwright

from node_support import Node
from ros_support import free_port, ros_environment, start, stop, wait_until
from web_support import TIMEOUT, TOKEN, launch_browser, new_page


class ToolsPage:
    """The window of a scene; `page` is Playwright's, `errors` what the browser's console has reported."""

    page: Page

    def __init__(self, folder: Path, scene: str, *options: object, env: Mapping[str, str] | None = None) -> None:
        self._folder = folder
        self._scene = [scene, *([] if env else ["--no-ros"]), *options]
        self.env = dict(env or ros_environment(free_port(), folder))
        self.port = free_port()
        self.errors: list[str] = []

    def __enter__(self) -> Self:
        with ExitStack() as ends:  # what has begun ends if the rest fails: Playwright left running fails later tests
            self._start_node_and_server(ends)
            self._open_page(ends)
            self._ends = ends.pop_all()
        return self

    def _start_node_and_server(self, ends: ExitStack) -> None:
        remote_port = free_port()
        self.node = ends.enter_context(
            Node(self.env, self._folder / "node.txt", *self._scene, f"--remote={remote_port}", "--start")
        )
        wait_until(lambda: "remote clients can connect" in self.node.output, "the remote API", timeout=TIMEOUT / 1000)
        command = [sys.executable, "-m", "bubblesim.web", "--remote", str(remote_port), "--port", str(self.port)]
        log = self._folder / "server.txt"
        with log.open("w") as output:
            self.server = start(command, self.env | TOKEN, cwd=self._folder, stdout=output, stderr=subprocess.STDOUT)
        ends.callback(stop, self.server)
        wait_until(lambda: "the window is at" in log.read_text(), "the server", timeout=TIMEOUT / 1000)

    def _open_page(self, ends: ExitStack) -> None:
        browser = launch_browser(ends.enter_context(sync_playwright()))
        ends.callback(browser.close)
        self.page = new_page(browser, 1400, 900)
        self.page.on("console", lambda message: self.errors.append(message.text) if message.type == "error" else None)
        self.page.on("pageerror", lambda error: self.errors.append(str(error)))
        self.page.goto(f"http://127.0.0.1:{self.port}/#token=t")
        self.wait_for("window.bubblesim?.scene.objects.size > 0")

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, traceback: TracebackType | None
    ) -> None:
        self._ends.close()

    def show(self, panel: str) -> None:
        """Bring a panel to the front."""
        self.page.click(f'.tab[data-panel="{panel}"]')

    def call(self, function: str, *arguments: Any) -> Any:
        """Call a function as the page does."""
        return self.page.evaluate("([name, args]) => bubblesim.link.call(name, args)", [function, list(arguments)])

    def wait_for(self, condition: str) -> None:
        """Wait until an expression of JavaScript is true. The page's policy forbids Playwright's own way to wait."""
        wait_until(lambda: bool(self.page.evaluate(f"Boolean({condition})")), condition, timeout=TIMEOUT / 1000)
