# SPDX-License-Identifier: BSD-3-Clause
"""Masses, friction, motor gain and noise in the properties of the page."""

from collections.abc import Callable
from pathlib import Path

import pytest

pytest.importorskip("playwright", reason="scripts/setup --with tests installs it")

from node_support import write
from web_support import Node, Window

Show = Callable[..., Window]

SCENE = """\
<sdf version="1.9">
  <world name="numbers">
    <model name="box"><pose>0 0 0.1 0 0 0</pose><link name="link">
      <inertial><mass>2</mass></inertial>
      <collision name="c"><geometry><box><size>0.2 0.2 0.2</size></box></geometry></collision>
      <visual name="v"><geometry><box><size>0.2 0.2 0.2</size></box></geometry></visual>
      <sensor name="imu" type="imu"/>
    </link></model>
  </world>
</sdf>
"""


def shown(page: Window, name: str, value: float) -> None:
    page.wait(f"document.querySelector('.properties input[name={name}]')?.value === String(x)", value)


def test_mass_and_friction_are_set_undone_kept_and_saved(tmp_path: Path, show: Show) -> None:
    with Node(tmp_path, str(write(tmp_path / "numbers.sdf", SCENE))) as node:
        page = show(node)
        page.button("Stop").click()
        page.wait("bubblesim.link.frame.state === 'stopped'")
        page.select("/box/link")
        shown(page, "mass", 2)
        page.page.fill(".properties input[name=mass]", "5")
        page.page.keyboard.press("Enter")
        page.wait("bubblesim.editing.done.length === 1")
        page.page.fill(".properties input[name=friction]", "0.25")
        page.page.keyboard.press("Enter")
        page.wait("bubblesim.editing.done.length === 2")
        page.page.locator(".view canvas").focus()
        page.button("Undo: friction").click()
        shown(page, "friction", 1)
        page.button("Play").click()
        page.wait("bubblesim.link.frame.time > 0.2")
        page.button("Stop").click()
        page.wait("bubblesim.link.frame.time === 0")
        shown(page, "mass", 5)
        assert page.call("sim.getShapeMass", page.js("bubblesim.scene.byPath('/box/link').handle")) == 5


def test_the_noise_of_a_sensor_is_that_of_the_run(tmp_path: Path, show: Show) -> None:
    with Node(tmp_path, str(write(tmp_path / "numbers.sdf", SCENE)), "--paused") as node:
        page = show(node)
        page.select("/box/link/imu")
        shown(page, "noise_scale", 1)
        page.page.fill(".properties input[name=noise_scale]", "3")
        page.page.keyboard.press("Enter")
        page.wait("bubblesim.editing.done.length === 1")
        page.button("Stop").click()
        shown(page, "noise_scale", 1)
