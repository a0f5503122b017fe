# SPDX-License-Identifier: BSD-3-Clause
"""The tree and the properties of the selection, in a real browser."""

from collections.abc import Callable
from pathlib import Path

import pytest

from web_support import Node, Window

Show = Callable[..., Window]


def test_the_tree_shows_one_kind_of_objects(tmp_path: Path, show: Show) -> None:
    with Node(tmp_path, "tricycle", "--paused") as node:
        page = show(node)
        page.page.locator("select.kind").select_option("sensor")
        page.wait("document.querySelectorAll('.treerow').length === 3")
        rows = page.page.locator(".treerow .name").all_inner_texts()
        assert [row.rpartition("/")[2] for row in rows] == ["FrontSonar", "Camera", "Gps"]


def test_the_slider_of_a_joint_goes_to_its_limits_and_sets_the_target(tmp_path: Path, show: Show) -> None:
    with Node(tmp_path, "tricycle", "--paused") as node:
        page = show(node)
        joint = page.js("[...bubblesim.scene.objects.values()].find((e) => e.name === 'Steering').path")
        page.select(joint)
        page.page.locator(".properties select[title='Mode of the motor']").select_option("position")
        slider = page.page.locator(".properties input[type=range]")
        page.wait("document.querySelector('.properties input[type=range]').max === '1.5'")
        assert slider.get_attribute("min") == "-1.5"
        slider.fill("0.4")
        page.wait("Number(document.querySelector('.properties input[title=Target]').value) === 0.4")
        handle = page.js("bubblesim.selection.object.handle")
        assert page.call("sim.getJointTargetPosition", handle) == pytest.approx(0.4)
        page.button("One step").click()
        page.wait("Math.abs(bubblesim.link.frame.joints[0]) > 0.001")


def test_readings_are_numbers_pictures_and_scans(tmp_path: Path, show: Show) -> None:
    with Node(tmp_path, "sensors") as node:
        page = show(node)
        pixels = "canvas.getContext('2d').getImageData(0, 0, canvas.width, canvas.height).data.buffer"
        colours = f"((canvas) => (canvas.hidden ? 0 : new Set(new Uint32Array({pixels})).size))"
        for sensor, drawn in (("Camera", "> 8"), ("DepthCamera", "> 8"), ("Lidar", "> 2"), ("Sonar", "=== 0")):
            page.select(page.js("[...bubblesim.scene.objects.values()].find((e) => e.name === x).path", sensor))
            page.wait("/time.*[0-9] s/.test(document.querySelector('.properties').textContent)")
            page.wait(f"{colours}(document.querySelector('.properties canvas.reading')) {drawn}")
