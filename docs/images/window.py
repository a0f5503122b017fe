# SPDX-License-Identifier: BSD-3-Clause
"""Takes the picture of the window: python docs/images/window.py. Needs `scripts/setup --with tests`."""

import os
import re
import subprocess
import tempfile
import time
from pathlib import Path

from playwright.sync_api import sync_playwright

from bubblesim.running.places import node_program

PICTURE = Path(__file__).parent / "window.png"
FLAGS = ["--use-angle=swiftshader", "--enable-unsafe-swiftshader", "--no-sandbox"]
PREPARE = """async () => {
  const { scene, selection, view, layout } = bubblesim;
  await view.settled();
  const sonar = [...scene.objects.values()].find((each) => each.parameters?.kind === "proximity");
  selection.select(sonar ?? scene.byPath("/Tricycle"));
  for (const id of ["sensors", "joints", "points"]) view.setOverlay(id, true);
  layout.show("tree");
  view.viewpoint.look(scene.byPath("/Tricycle"));
}"""


def picture(address: str) -> None:
    """Save the picture of a window."""
    with sync_playwright() as playwright:
        browser = playwright.chromium.launch(executable_path="/usr/bin/chromium-headless-shell", args=FLAGS)
        page = browser.new_page(viewport={"width": 1280, "height": 720}, color_scheme="dark")
        page.add_init_script("localStorage.setItem('first-steps', 'known')")  # the line of a first visit
        page.goto(address)
        while not page.evaluate("bubblesim.scene.models.length"):
            page.wait_for_timeout(200)
        page.evaluate(PREPARE)
        page.wait_for_timeout(4000)
        page.evaluate("for (const each of [0, 1]) bubblesim.view.camera.position.multiplyScalar(1.12)")
        page.wait_for_timeout(3000)
        page.screenshot(path=PICTURE, timeout=120_000)
        browser.close()


def main() -> None:
    """Run the tricycle, which drives a curve, and take the picture."""
    with tempfile.TemporaryDirectory() as folder:
        log = Path(folder) / "log"
        command = [str(node_program()), "tricycle", "--no-ros", "--web"]
        environment = os.environ | {"BUBBLESIM_WEB_TOKEN": "picture"}
        with log.open("w") as errors, subprocess.Popen(command, env=environment, stderr=errors) as node:
            try:
                while not (address := re.search(r"the window is at (\S+)", log.read_text())):
                    time.sleep(0.2)
                picture(f"{address[1]}#token=picture")
            finally:
                node.terminate()


if __name__ == "__main__":
    main()
