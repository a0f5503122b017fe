# SPDX-License-Identifier: BSD-3-Clause
"""Copies of shipped scenes, from the editor of the window in a real browser."""

from collections.abc import Callable
from pathlib import Path

import pytest

pytest.importorskip("playwright")

from bubblesim import scene_folders
from web_support import Node, Window

Show = Callable[..., Window]
SHIPPED = Path(scene_folders()[-1])


@pytest.fixture(autouse=True)
def _own_folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """The window writes into the folder where it was started."""
    (tmp_path / "here").mkdir()
    monkeypatch.chdir(tmp_path / "here")


def edit(page: Window) -> None:
    """Write a line at the top of the scene's script."""
    page.page.click('.tab[data-panel="scripts"]')
    page.page.wait_for_selector(".cm-content:has-text('sysCall_init')")
    page.page.click(".cm-content")
    page.page.keyboard.press("Control+Home")
    page.page.keyboard.type("print('my own')\n")


def test_an_edited_script_is_saved_as_a_copy_which_is_opened(tmp_path: Path, show: Show) -> None:
    shipped = (SHIPPED / "ball.py").read_text()
    with Node(tmp_path, "ball", "--paused") as node:
        page = show(node)
        edit(page)
        page.page.click(".scripts button:has-text('Save a copy')")
        assert page.page.input_value(".saving input") == "my_ball"
        page.page.click(".saving button[type=submit]")
        file = tmp_path / "here" / "my_ball.sdf"
        page.wait("bubblesim.scene.info?.file === x", str(file))
        page.page.wait_for_selector(".scripts .file:has-text('my_ball/ball.py')")
        assert page.page.locator(".scripts button:has-text('Save a copy')").is_hidden()
        page.button("Play (Space)").click()
        page.wait("bubblesim.link.frame.time > 0")
        assert "my own" in (tmp_path / "node.out").read_text()
    assert (tmp_path / "here" / "my_ball" / "ball.py").read_text() == f"print('my own')\n{shipped}"
    assert (SHIPPED / "ball.py").read_text() == shipped


def test_a_name_that_is_taken_is_refused_and_the_edit_stays(tmp_path: Path, show: Show) -> None:
    (tmp_path / "here" / "my_ball.sdf").write_text("theirs")
    with Node(tmp_path, "ball", "--paused") as node:
        page = show(node)
        edit(page)
        page.page.click(".scripts button:has-text('Save a copy')")
        page.page.click(".saving button[type=submit]")
        page.page.wait_for_selector(".notice:has-text('my_ball.sdf exists already: choose another name')")
        assert "my own" in page.page.inner_text(".cm-content")
    assert (tmp_path / "here" / "my_ball.sdf").read_text() == "theirs"


def test_copies_are_written_only_where_the_window_may(tmp_path: Path, show: Show) -> None:
    with Node(tmp_path, "ball", "--paused") as node:
        page = show(node)
        assert page.call("server.copyFolders") == [str(tmp_path / "here")]
        with pytest.raises(Exception, match="no copy can be written to /tmp"):
            page.call("server.openCopy", "/tmp", "mine", [])
