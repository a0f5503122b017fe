# SPDX-License-Identifier: BSD-3-Clause
"""Opening files of CoppeliaSim in the window, in a real browser."""

from collections.abc import Callable
from pathlib import Path

import pytest

from ttt_files import BOX, FLOOR, LUA, PYTHON, script, write
from web_support import Node, Window

Show = Callable[..., Window]


@pytest.fixture(autouse=True)
def _own_folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """The window writes into the folder where it was started."""
    (tmp_path / "here").mkdir()
    monkeypatch.chdir(tmp_path / "here")


def choose(page: Window, file: Path) -> None:
    """Give the window a file, and wait for its question."""
    page.open_file(file)
    page.page.wait_for_selector(".opening[open]")


def opened(page: Window, name: str) -> None:
    """Press Open, and wait for the scene."""
    page.page.click(".opening button[type=submit]")
    page.wait("bubblesim.scene.info?.file.endsWith(x) && bubblesim.scene.byPath('/Box')", f"/{name}.sdf")


def printed(tmp_path: Path) -> str:
    return (tmp_path / "node.out").read_text()


def run_for_a_moment(page: Window) -> None:
    page.button("Play (Space)").click()
    page.wait("bubblesim.link.frame.time > 0.3")


def test_a_scene_is_opened_with_its_lua_scripts(tmp_path: Path, show: Show) -> None:
    file = write(tmp_path / "my box.ttt", FLOOR, BOX, script(2, LUA))
    with Node(tmp_path, "ball", "--paused") as node:
        page = show(node)
        choose(page, file)
        assert "Box.lua (Lua, in the sandbox)" in page.page.inner_text(".opening")
        assert "it is Box" not in printed(tmp_path)
        assert list((tmp_path / "here").iterdir()) == []
        opened(page, "my_box")
        assert {each.name for each in (tmp_path / "here").iterdir()} == {"my_box", "my_box.sdf"}
        run_for_a_moment(page)
        assert "it is Box" in printed(tmp_path)
        box = page.js("bubblesim.scene.byPath('/Box').handle")
        assert page.call("window.get_state", box)["pose"][2] < 0.5  # it falls, as in the file


@pytest.mark.parametrize("allowed", [False, True])
def test_python_scripts_run_only_if_the_user_allows_them(tmp_path: Path, show: Show, *, allowed: bool) -> None:
    file = write(tmp_path / "box.ttt", FLOOR, BOX, script(2, PYTHON, "python"))
    with Node(tmp_path, "ball", "--paused") as node:
        page = show(node)
        choose(page, file)
        assert "may do whatever you may" in page.page.inner_text(".opening")
        if allowed:
            page.page.check(".opening .trust input")
        opened(page, "box")
        run_for_a_moment(page)
        assert ("python runs" in printed(tmp_path)) == allowed
        assert (tmp_path / "here/box/scripts/Box.py").is_file()  # to be read


def test_a_model_stands_on_a_floor_and_can_be_saved(tmp_path: Path, show: Show) -> None:
    file = write(tmp_path / "box.ttm", BOX, is_scene=False)
    with Node(tmp_path, "ball", "--paused") as node:
        page = show(node)
        choose(page, file)
        opened(page, "box")
        saved = page.call("server.saveScene", str(tmp_path / "here"), "mine", False)
        assert saved["saved"]


def test_a_name_that_is_taken_gets_a_number(tmp_path: Path, show: Show) -> None:
    (tmp_path / "here/box.sdf").write_text("precious")
    file = write(tmp_path / "box.ttt", FLOOR, BOX)
    with Node(tmp_path, "ball", "--paused") as node:
        page = show(node)
        choose(page, file)
        opened(page, "box_2")
    assert (tmp_path / "here/box.sdf").read_text() == "precious"


def test_a_damaged_file_is_refused_and_the_scene_stays(tmp_path: Path, show: Show) -> None:
    file = tmp_path / "bad.ttt"
    file.write_bytes(b"VREP" + bytes(100))
    with Node(tmp_path, "ball", "--paused") as node:
        page = show(node)
        page.open_file(file)
        page.page.wait_for_selector(".notice.error:has-text('bad.ttt')")
        assert page.js("bubblesim.scene.byPath('/Ball') !== undefined")
        other = tmp_path / "a.txt"
        other.write_text("x")
        page.open_file(other)
        page.page.wait_for_selector(".notice.error:has-text('a.txt: this window opens')")
    assert list((tmp_path / "here").iterdir()) == []


def test_a_read_only_window_opens_no_scenes(tmp_path: Path, show: Show) -> None:
    file = write(tmp_path / "box.ttt", FLOOR, BOX)
    with Node(tmp_path, "ball", "--paused", "--web-edit=false") as node:
        page = show(node)
        page.open_file(file)
        page.page.wait_for_selector(".notice.error:has-text('read-only')")
        for call in (["server.readForeign", ["box.ttt", None]], ["server.openForeign", [str(tmp_path), False]]):
            assert "read-only" in page.js("bubblesim.link.call(...x).catch((e) => e.message)", call)


def test_scenes_are_written_only_where_the_window_may(tmp_path: Path, show: Show) -> None:
    file = write(tmp_path / "box.ttt", FLOOR, BOX)
    with Node(tmp_path, "ball", "--paused") as node:
        page = show(node)
        choose(page, file)
        call = ["server.openForeign", [str(tmp_path), False]]
        assert "cannot be written to" in page.js("bubblesim.link.call(...x).catch((e) => e.message)", call)
