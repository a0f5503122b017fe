# SPDX-License-Identifier: BSD-3-Clause
"""The tree of objects in the page is the one that scripts see, in a real browser."""

from collections.abc import Callable
from pathlib import Path

import pytest

pytest.importorskip("playwright")

from node_support import write
from web_support import Node, Window

Show = Callable[..., Window]

SCENE = """\
<sdf version="1.9" xmlns:bubblesim="https://bubblesim">
  <world name="places">
    <model name="robot body">
      <bubblesim:is_object>false</bubblesim:is_object>
      <link name="base"><bubblesim:place><id>1</id></bubblesim:place></link>
      <link name="arm"><bubblesim:place><id>3</id><parent>2</parent></bubblesim:place></link>
      <joint name="motor" type="revolute">
        <parent>base</parent><child>arm</child><axis><xyz>0 0 1</xyz></axis>
        <bubblesim:place><id>2</id><parent>1</parent></bubblesim:place>
      </joint>
    </model>
    <bubblesim:object name="goal"/>
  </world>
</sdf>
"""
FOUND = "(x[0] ? bubblesim.scene.byPath(x[0])?.children : bubblesim.scene.children()) ?? []"
NAMES = f"JSON.stringify(({FOUND}).map((each) => each.name))"


def children(page: Window, path: str, names: list[str]) -> None:
    """Wait until an object, or for an empty path the scene, has these children."""
    page.wait(f"{NAMES} === JSON.stringify(x[1])", [path, names])


def test_the_tree_is_that_of_scripts_and_follows_their_changes(tmp_path: Path, show: Show) -> None:
    with Node(tmp_path, str(write(tmp_path / "places.sdf", SCENE)), "--paused") as node:
        page = show(node)
        children(page, "", ["base", "goal"])
        children(page, "/base", ["motor"])
        children(page, "/base/motor", ["arm"])
        goal, motor = (page.js("bubblesim.scene.byPath(x).handle", path) for path in ("/goal", "/base/motor"))
        page.call("sim.setObjectParent", goal, motor, True)
        page.call("sim.setObjectAlias", goal, "mark")
        children(page, "/base/motor", ["arm", "mark"])
        tip = page.call("sim.createDummy", 0.01)
        children(page, "", ["base", "Dummy"])
        page.call("sim.removeObjects", [tip])
        children(page, "", ["base"])


def test_an_object_of_no_model_stays_selected_while_others_change(tmp_path: Path, show: Show) -> None:
    with Node(tmp_path, str(write(tmp_path / "places.sdf", SCENE)), "--paused") as node:
        page = show(node)
        children(page, "", ["base", "goal"])
        page.js("bubblesim.selection.select(bubblesim.scene.byPath('/goal'))")
        page.call("sim.createDummy", 0.01)
        children(page, "", ["base", "goal", "Dummy"])
        assert page.js("bubblesim.selection.object?.path") == "/goal"
