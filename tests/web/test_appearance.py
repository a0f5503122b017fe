# SPDX-License-Identifier: BSD-3-Clause
"""The panels look as in the pictures of tests/web/pictures, at three sizes, light and dark.

A picture has all panels of one size and colour scheme, in rows of four. After a change that is wanted, write them
anew with `pytest --long --renew-pictures tests/web/test_appearance.py`, and look at them.
"""

import io
from pathlib import Path

import numpy as np
import pytest

pytest.importorskip("playwright")

from PIL import Image
from playwright.sync_api import Browser

from web_support import TIMEOUT, Node, Window

pytestmark = pytest.mark.long  # pictures of a hundred pages, drawn without a GPU

PICTURES = Path(__file__).with_name("pictures")
WIDTH = 480  # of a page in a picture, in pixels
COLUMNS = 4
BLOCK = 12  # pixels: what moves by less is in the same block; an entry of a list is as high
MOST_DIFFERENCE = 20.0  # of the mean of a block, of 255: between two versions of a font 8 were seen
MOST_BLOCKS = 0.01  # share of blocks that may differ more


# The models that are in view have their pictures, which are drawn one after the other.
_MODELS_ARE_DRAWN = """[...document.querySelectorAll(".modelcard")]
  .filter((each) => each.getBoundingClientRect().height && each.getBoundingClientRect().top < innerHeight)
  .every((each) => each.querySelector(".picture").style.backgroundImage)"""

# Where the scene lies is another place on each machine.
_HIDE_PATHS = """document.querySelectorAll(".scripts .file").forEach((each) => {
  each.textContent = each.textContent.split("/").at(-1);
})"""


def panel_pictures(window: Window) -> list[Image.Image]:
    """Return a picture of the page with each panel in front."""
    window.js("bubblesim.layout.showFor({ ros: true })")  # also the tabs that need it
    window.select("/Tricycle/Steering")
    pictures = []
    for panel in window.js("[...document.querySelectorAll('.tab[data-panel]')].map((each) => each.dataset.panel)"):
        window.js("bubblesim.layout.show(x)", panel)
        window.page.wait_for_timeout(600)  # what the panel asks the server for
        window.js(_HIDE_PATHS)
        window.wait(_MODELS_ARE_DRAWN)
        window.js("bubblesim.view.settled()")
        shot = Image.open(io.BytesIO(window.page.screenshot(timeout=TIMEOUT, animations="disabled"))).convert("RGB")
        pictures.append(shot.resize((WIDTH, WIDTH * shot.height // shot.width), Image.Resampling.LANCZOS))
    return pictures


def sheet(pictures: list[Image.Image]) -> Image.Image:
    """Return pictures of the same size beside and below each other."""
    width, height = pictures[0].size
    whole = Image.new("RGB", (COLUMNS * width, -(-len(pictures) // COLUMNS) * height))
    for number, picture in enumerate(pictures):
        whole.paste(picture, (number % COLUMNS * width, number // COLUMNS * height))
    return whole


def block_means(picture: Image.Image) -> np.ndarray:
    """Return the mean colour of each block."""
    width, height = (size // BLOCK for size in picture.size)
    pixels = np.asarray(picture, dtype=float)[: height * BLOCK, : width * BLOCK]
    return pixels.reshape(height, BLOCK, width, BLOCK, 3).mean(axis=(1, 3))


@pytest.mark.parametrize("scheme", ["light", "dark"])
@pytest.mark.parametrize("size", ["1280x800", "1024x768", "1920x1080"])
def test_the_panels_look_as_in_the_pictures(
    tmp_path: Path, browser: Browser, request: pytest.FixtureRequest, size: str, scheme: str
) -> None:
    width, height = map(int, size.split("x"))
    with Node(tmp_path, "tricycle", "--paused") as node:
        context = browser.new_context(viewport={"width": width, "height": height}, color_scheme=scheme)  # type: ignore[arg-type]
        page = context.new_page()
        page.set_default_timeout(TIMEOUT)
        page.add_init_script("localStorage.setItem('first-steps', 'known')")
        window = Window(page, node.address)
        node.windows.append(window)
        seen = sheet(panel_pictures(window))
    reference = PICTURES / f"{size}_{scheme}.webp"
    if request.config.getoption("--renew-pictures"):
        seen.save(reference, quality=60)
        return
    expected = Image.open(reference).convert("RGB")
    assert seen.size == expected.size
    different = np.abs(block_means(seen) - block_means(expected)).max(axis=2) > MOST_DIFFERENCE
    seen.save(tmp_path / reference.name)
    rows, columns = np.nonzero(different)
    places = ", ".join(f"({BLOCK * column}, {BLOCK * row})" for row, column in zip(rows, columns, strict=True))
    assert different.mean() <= MOST_BLOCKS, f"{tmp_path / reference.name} differs from {reference} at {places[:200]}"
