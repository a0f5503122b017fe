# SPDX-License-Identifier: BSD-3-Clause
"""Saving the scene in the window, in a real browser."""

from collections.abc import Callable, Iterator
from pathlib import Path

import pytest

pytest.importorskip("playwright")

from playwright.sync_api import Dialog

from bubblesim import Simulation
from node_support import write
from tools_page import ToolsPage
from web_support import Node, Window

Show = Callable[..., Window]

SCENE = """\
<?xml version="1.0"?>
<sdf version="1.9">
  <world name="boxes">
    <model name="ground"><static>true</static><link name="link">
      <collision name="c"><geometry><plane/></geometry></collision>
    </link></model>
    <model name="box"><pose>0 0 0.1 0 0 0</pose><link name="link">
      <collision name="c"><geometry><box><size>0.2 0.2 0.2</size></box></geometry></collision>
      <visual name="v"><geometry><box><size>0.2 0.2 0.2</size></box></geometry></visual>
    </link></model>
    <model name="ball"><pose>2 0 0.1 0 0 0</pose><link name="link">
      <collision name="c"><geometry><sphere><radius>0.1</radius></sphere></geometry></collision>
    </link></model>
    <model name="gone"><pose>3 0 0.1 0 0 0</pose><link name="link">
      <collision name="c"><geometry><sphere><radius>0.1</radius></sphere></geometry></collision>
    </link></model>
  </world>
</sdf>
"""


@pytest.fixture
def window(tmp_path: Path) -> Iterator[ToolsPage]:
    with ToolsPage(tmp_path, str(write(tmp_path / "boxes.sdf", SCENE))) as window:
        yield window
        assert window.errors == []


# Notices are shown for a few seconds only: a busy machine may look too late.
LISTEN = """(() => {
  window.shown = [];
  window.listening?.disconnect();
  window.listening = new MutationObserver((changes) => {
    for (const { addedNodes } of changes) window.shown.push(...[...addedNodes].map((each) => each.innerText));
  });
  window.listening.observe(document.querySelector(".notices"), { childList: true });
})()"""


def stop(window: ToolsPage) -> None:
    """Stop the simulation that runs, and wait until it is at the start again."""
    window.wait_for("bubblesim.link.frame?.time > 0")
    window.call("window.stop")  # returns before
    window.wait_for("bubblesim.link.frame.state === 'stopped'")


def save_as(window: ToolsPage, name: str, *, overwrite: bool = False) -> list[str]:
    """Save under a name, answer the question, and return it and what the page shows then."""
    strings: list[str] = []
    window.page.evaluate(LISTEN)

    def answer(dialog: Dialog) -> None:
        strings.append(dialog.message)
        if overwrite:
            dialog.accept()
        else:
            dialog.dismiss()

    window.page.on("dialog", answer)
    window.page.click("button[title^='Save scene as']")
    window.page.fill(".saving input", name)
    window.page.click(".saving button[type=submit]")
    window.wait_for("!document.querySelector('.saving[open] button:disabled')")
    window.page.remove_listener("dialog", answer)
    strings += window.page.evaluate("window.shown")
    window.page.evaluate("document.querySelector('.saving[open]')?.close()")
    window.wait_for("!document.querySelector('.saving')")
    return strings


def test_what_was_edited_is_saved(window: ToolsPage, tmp_path: Path) -> None:
    stop(window)
    box = window.call("sim.getObject", "/box")
    window.call("window.duplicate", box, [1, 0, 0.1, 0, 0, 0, 1])
    window.call("window.set_pose", box, [0, 1, 0.1, 0, 0, 0, 1])
    window.call("window.restore", window.call("window.remove", window.call("sim.getObject", "/ball")))
    window.call("window.remove", window.call("sim.getObject", "/gone"))
    (shown,) = save_as(window, "mine")
    assert shown == f"Saved to {tmp_path / 'mine.sdf'}"
    world = Simulation(str(tmp_path / "mine.sdf")).world
    names = {world.name(model): list(world.pose(model)) for model in world.models}
    assert names == {
        "ground": [0, 0, 0, 0, 0, 0, 1],
        "box": [0, 1, 0.1, 0, 0, 0, 1],
        "box_1": [1, 0, 0.1, 0, 0, 0, 1],
        "ball": [2, 0, 0.1, 0, 0, 0, 1],
    }


def test_nothing_is_overwritten_without_asking(window: ToolsPage, tmp_path: Path) -> None:
    file = write(tmp_path / "mine.sdf", "mine\n")
    window.wait_for("bubblesim.link.frame?.time > 0")
    assert "stop the simulation before you save" in save_as(window, "other")[-1]
    stop(window)
    assert save_as(window, "mine.sdf")[0] == f"{file} exists. Overwrite it?"
    assert file.read_text() == "mine\n"
    assert save_as(window, "mine", overwrite=True)[-1] == f"Saved to {file}"
    assert "box" in file.read_text()
    assert "is not the name of a file" in save_as(window, "../mine")[-1]


def test_the_saved_scene_has_the_same_state_hash(tmp_path: Path, show: Show, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    with Node(tmp_path, "tricycle", "--paused") as node:  # it has not run yet
        page = show(node)
        tricycle = page.js("bubblesim.scene.byPath('/Tricycle').handle")
        pose = [1, 2, 0.1, 0, 0, 0, 1]
        page.call("window.set_pose", tricycle, pose)
        saved = page.call("server.saveScene", str(tmp_path), "mine", False)
        assert saved == {"file": str(tmp_path / "mine.sdf"), "saved": True}
        expected = Simulation("tricycle")
        expected.world.set_state(tricycle, pose, [0, 0, 0], [0, 0, 0])
        assert Simulation(saved["file"]).state_hash() == expected.state_hash()
        elsewhere = [str(tmp_path.parent), "mine", True]
        error = page.js("bubblesim.link.call('server.saveScene', x).catch((e) => e.message)", elsewhere)
        assert "cannot be saved in" in error


def test_a_pose_of_the_stopped_scene_is_that_of_the_next_start(tmp_path: Path, show: Show) -> None:
    with Node(tmp_path, "ball", "--paused") as node:
        page = show(node)
        page.button("Stop").click()
        page.wait("bubblesim.link.frame.state === 'stopped'")
        ball = page.js("bubblesim.scene.byPath('/Ball').handle")
        page.call("window.set_pose", ball, [2, 0, 1, 0, 0, 0, 1])
        page.button("Play").click()
        page.wait("bubblesim.link.frame.time > 0.2")
        error = page.js("bubblesim.link.call('window.get_scene_text', ['/']).catch((e) => e.message)")
        assert "stop the simulation" in error
        page.button("Stop").click()
        page.wait("bubblesim.link.frame.state === 'stopped' && bubblesim.link.frame.time === 0")
        assert page.call("window.get_state", ball)["pose"][:3] == [2, 0, 1]
