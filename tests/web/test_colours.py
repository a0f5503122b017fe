# SPDX-License-Identifier: BSD-3-Clause
"""Colours that pages and scripts set, in a real browser."""

from collections.abc import Callable
from pathlib import Path

import pytest

pytest.importorskip("playwright")

from node_support import write
from web_support import Node, Window

Show = Callable[..., Window]

SCENE = """\
<?xml version="1.0"?>
<sdf version="1.9">
  <world name="colours">
    <model name="ground"><static>true</static><link name="link">
      <collision name="c"><geometry><plane/></geometry></collision>
    </link></model>
    <model name="box"><pose>2 0 0.5 0 0 0</pose><link name="link">
      <collision name="c"><geometry><box><size>1 1 1</size></box></geometry></collision>
      <visual name="v"><geometry><box><size>1 1 1</size></box></geometry></visual>
      <visual name="glows"><pose>0 0 0.6 0 0 0</pose><geometry><sphere><radius>0.3</radius></sphere></geometry>
        <material><diffuse>0 0 1 1</diffuse><emissive>0 0.5 0 1</emissive></material></visual>
    </link></model>
    <model name="eye"><static>true</static><pose>0 0 0.8 0 0 0</pose><link name="link">
      <sensor name="camera" type="camera"><update_rate>20</update_rate><camera>
        <image><width>64</width><height>48</height></image><clip><near>0.1</near><far>20</far></clip>
      </camera></sensor>
    </link></model>
  </world>
</sdf>
"""
SHOWN = "bubblesim.view.bodies.partsOf(bubblesim.scene.byPath(x).handle).map(({ colour }) => colour.toArray())"


def colour_shown(page: Window, path: str, colour: list[float]) -> None:
    page.wait(
        f"JSON.stringify({SHOWN}) === JSON.stringify(x[1])".replace("Path(x)", "Path(x[0])"), [path, [colour] * 2]
    )


def test_a_colour_that_is_set_in_the_page_is_seen_by_cameras_copies_and_other_pages(tmp_path: Path, show: Show) -> None:
    with Node(tmp_path, str(write(tmp_path / "colours.sdf", SCENE)), "--paused") as node:
        page = show(node)
        page.select("/box/link")
        page.page.fill(".properties input.colour", "#ff0000")
        colour_shown(page, "/box/link", [1, 0, 0])
        link = page.js("bubblesim.scene.byPath('/box/link').handle")
        assert page.call("sim.getShapeColor", link, None, 0) == [1, [1, 0, 0]]
        page.button("One step").click()
        page.wait("bubblesim.link.frame.time > 0")
        assert page.difference_from_camera() < 0.02
        colour_shown(show(node), "/box/link", [1, 0, 0])
        page.js("bubblesim.editing.duplicate(bubblesim.scene.byPath('/box'))")
        page.wait("bubblesim.scene.byPath('/box_1')")
        colour_shown(page, "/box_1/link", [1, 0, 0])
        page.page.locator(".view canvas").focus()
        page.button("Undo: copy").click()
        page.wait("!bubblesim.scene.byPath('/box_1')")
        page.button("Undo: colour").click()
        before = page.js("bubblesim.scene.byPath('/box/link').visuals[0].material.diffuse")
        colour_shown(page, "/box/link", before)


def test_colours_that_scripts_set_are_shown(tmp_path: Path, show: Show) -> None:
    code = "def sysCall_init(): self.box = sim.getObject('.')\n"
    code += "def sysCall_sensing():\n    on = int(sim.getSimulationTime() / 0.2) % 2\n"
    code += "    sim.setShapeColor(self.box, None, sim.colorcomponent_ambient_diffuse, [0, on, 1])\n"
    script = write(tmp_path / "blink.py", code)
    scene = str(write(tmp_path / "colours.sdf", SCENE))
    with Node(tmp_path, scene, "--child-script", f"/box={script}") as node:
        page = show(node)
        for on in (0, 1, 0, 1):
            colour_shown(page, "/box/link", [0, on, 1])
        page.button("Stop").click()
        page.wait("bubblesim.link.frame.time === 0")
