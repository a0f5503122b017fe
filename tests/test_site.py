# SPDX-License-Identifier: BSD-3-Clause
"""The site of the documentation: it builds without a network, its links lead somewhere, and its search finds pages."""

import importlib.util
import re
import shutil
import subprocess
import sys
from pathlib import Path
from typing import Literal

import pytest
from playwright.sync_api import sync_playwright

from ros_support import REPOSITORY
from web_support import TIMEOUT, launch_browser

PARTS = ("furo", "myst_parser", "sphinx", "sphinx_copybutton")
pytestmark = pytest.mark.skipif(
    any(importlib.util.find_spec(part) is None for part in PARTS), reason="Sphinx is missing: scripts/setup --with docs"
)
LOADED = re.compile(r'<(?:script[^>]* src|link[^>]* rel="stylesheet"[^>]* href|img[^>]* src)="(https?:[^"]*)"')

BACKGROUND = """(name) => {
  let at = document.querySelector(name);
  const color = (each) => getComputedStyle(each).backgroundColor;
  while (color(at) === "rgba(0, 0, 0, 0)") at = at.parentElement;
  return color(at).match(/[0-9]+/g).slice(0, 3).map(Number);
}"""


@pytest.fixture(scope="module")
def site(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Build it; a link without a target, a page that no list has, and a name without a description are errors."""
    folder = tmp_path_factory.mktemp("site")
    run = subprocess.run(
        [REPOSITORY / "scripts" / "docs", folder], capture_output=True, text=True, timeout=300, check=False
    )
    assert (run.returncode, run.stderr) == (0, "")
    assert run.stdout == f"file://{folder}/index.html\n"
    return folder


def test_pages_load_nothing_from_other_machines(site: Path) -> None:
    pages = list(site.rglob("*.html"))
    assert len(pages) > 60
    assert [found for page in pages for found in LOADED.findall(page.read_text())] == []


def test_what_a_page_needs_is_shown(site: Path) -> None:
    page = re.sub(r"<[^>]*>", "", (site / "tutorials" / "tricycle.html").read_text())
    assert re.search(
        r"Needs running\s+In another terminal: roslaunch bubblesim tricycle.launch controller:=false", page
    )
    assert "mine.py" in re.sub(r"<[^>]*>", "", (site / "tutorials" / "ball.html").read_text())


def test_the_reference_has_the_docstrings(site: Path) -> None:
    page = re.sub(r"<[^>]*>", "", (site / "site" / "python_api.html").read_text())
    assert "Equal seeds and equal commands give bitwise equal states in every process." in page


@pytest.mark.parametrize(
    ("query", "first"),
    [
        ("publish a lidar", "Your first robot > Publish a lidar or a camera"),
        ("troubleshooting", "Troubleshooting"),
    ],
)
def test_the_search_finds(site: Path, query: str, first: str) -> None:
    with sync_playwright() as playwright:
        browser = launch_browser(playwright)
        page = browser.new_page()
        page.goto(f"{(site / 'search.html').as_uri()}?q={query}", timeout=TIMEOUT)
        page.wait_for_selector("ul.search li a", timeout=TIMEOUT)
        page.wait_for_function("!document.querySelector('#search-results h2').innerText.includes('Searching')")
        found = [link.inner_text() for link in page.locator("ul.search li > a").all()]
        browser.close()
    assert found[0] == first


@pytest.mark.parametrize(("scheme", "is_dark"), [("light", False), ("dark", True)])
def test_pages_have_the_colours_of_the_system(site: Path, scheme: Literal["light", "dark"], is_dark: bool) -> None:
    with sync_playwright() as playwright:
        browser = launch_browser(playwright)
        page = browser.new_page(color_scheme=scheme)
        page.goto((site / "index.html").as_uri(), timeout=TIMEOUT)
        shown = {name: page.evaluate(BACKGROUND, name) for name in ("body", ".highlight pre")}
        browser.close()
    assert {name: sum(rgb) < 3 * 128 for name, rgb in shown.items()} == dict.fromkeys(shown, is_dark), shown


def test_a_link_that_leads_nowhere_fails_the_build(tmp_path: Path) -> None:
    docs = tmp_path / "docs"
    shutil.copytree(REPOSITORY / "docs" / "site", docs / "site")
    shutil.copy(REPOSITORY / "package.xml", tmp_path)
    (docs / "site" / "python_api.rst").unlink()
    (docs / "index.rst").write_text("Site\n====\n\n.. toctree::\n\n   page\n")
    command = [sys.executable, "-m", "sphinx", "-q", "-W", "-c", str(docs / "site"), str(docs), str(tmp_path / "out")]
    for target, fails in (("[x](other.md)", True), ("[x](index.rst)", False)):
        (docs / "page.md").write_text(f"# Page\n\n{target}\n")
        run = subprocess.run(command, capture_output=True, text=True, check=False)
        assert (run.returncode != 0, run.stderr != "") == (fails, fails), run.stderr
