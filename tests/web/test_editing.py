# SPDX-License-Identifier: BSD-3-Clause
"""Editing the scene in the page, in a real browser."""

import math
from collections.abc import Callable
from pathlib import Path

import pytest

from node_support import write
from web_support import Node, Window

Show = Callable[..., Window]

BOX = """\
<sdf version="1.9">
  <world name="box">
    <model name="ground"><static>true</static><link name="link">
      <collision name="c"><geometry><plane/></geometry></collision>
    </link></model>
    <model name="box"><pose>0 0 0.1 0 0 0</pose><link name="link">
      <collision name="c"><geometry><box><size>0.2 0.2 0.2</size></box></geometry></collision>
      <visual name="v"><geometry><box><size>0.2 0.2 0.2</size></box></geometry></visual>
    </link></model>
  </world>
</sdf>
"""


# Notes on which lines poses are set.
NOTE_LINES = """(() => {
  const { link } = bubblesim;
  const call = link.call.bind(link);
  bubblesim.lines = new Set();
  link.call = (name, args, line) => {
    if (name === "window.set_pose") bubblesim.lines.add(line);
    return call(name, args, line);
  };
})()"""


def test_objects_are_moved_copied_and_deleted_and_it_is_undone(tmp_path: Path, show: Show) -> None:
    with Node(tmp_path, "tricycle", "--paused") as node:
        page = show(node)
        page.select("/Tricycle")
        x = page.page.locator(".properties input[title='x, m']")
        page.wait("document.querySelector('.properties input[title=\"x, m\"]').value !== ''")
        before = page.call("window.get_state", page.js("bubblesim.selection.object.handle"))["pose"]
        x.fill("1.25")
        x.press("Enter")
        page.wait("Math.abs(bubblesim.view.poseOf(bubblesim.selection.object)[0] - 1.25) < 1e-3")
        page.page.locator(".view canvas").focus()
        page.button("Undo").click()
        page.wait("Math.abs(bubblesim.view.poseOf(bubblesim.selection.object)[0] - x) < 1e-3", before[0])
        page.js("bubblesim.editing.duplicate(bubblesim.selection.object)")
        page.wait("bubblesim.scene.byPath('/Tricycle_1')")
        page.wait("bubblesim.selection.object?.path === '/Tricycle_1'")
        page.page.keyboard.press("Delete")
        page.wait("!bubblesim.scene.byPath('/Tricycle_1')")
        page.button("Undo").click()
        page.wait("bubblesim.scene.byPath('/Tricycle_1')")
        page.button("Redo: delete").click()
        page.wait("!bubblesim.scene.byPath('/Tricycle_1')")
        page.page.keyboard.press("Control+z")
        page.wait("bubblesim.scene.byPath('/Tricycle_1')")
        page.button("Undo").click()
        page.wait("!bubblesim.scene.byPath('/Tricycle_1')")


def test_the_gizmo_moves_in_steps_of_the_grid(tmp_path: Path, show: Show) -> None:
    with Node(tmp_path, "tricycle", "--paused") as node:
        page = show(node)
        page.select("/Tricycle")
        page.look_at("/Tricycle")
        page.page.keyboard.press("w")
        page.page.keyboard.press("b")
        page.js("bubblesim.view.settled()")
        before = page.js("bubblesim.view.poseOf(bubblesim.selection.object)")
        handle = page.js(
            """(() => { const v = bubblesim.view, place = v.poseOf(bubblesim.selection.object);
            const c = v.camera.position.clone().set(...place.slice(0, 3)).project(v.camera);
            const b = v.element.getBoundingClientRect();
            return [b.left + (c.x + 1) / 2 * b.width, b.top + (1 - c.y) / 2 * b.height]; })()"""
        )
        page.page.mouse.move(*handle)
        page.page.mouse.down()
        for step in range(1, 9):
            page.page.mouse.move(handle[0] + 10 * step, handle[1])
        page.page.mouse.up()
        page.wait("bubblesim.editing.done.length === 1")
        page.wait("bubblesim.view.poseOf(bubblesim.selection.object)[0] !== x", before[0])
        after = page.call("window.get_state", page.js("bubblesim.selection.object.handle"))["pose"]
        moved = [round(10 * (a - b), 3) for a, b in zip(after[:3], before[:3], strict=True)]
        assert any(moved)
        assert all(abs(each - round(each)) < 0.01 for each in moved)


def test_the_ring_turns_in_steps_of_fifteen_degrees(tmp_path: Path, show: Show) -> None:
    with Node(tmp_path, "tricycle", "--paused") as node:
        page = show(node)
        page.select("/Tricycle")
        page.look_at("/Tricycle")
        page.look_from_above()  # where the ring of the yaw is a circle
        page.page.keyboard.press("e")
        page.page.keyboard.press("b")
        page.js("bubblesim.view.settled()")
        before = page.js("bubblesim.view.poseOf(bubblesim.selection.object)")
        centre, radius = page.js(
            """(() => { const v = bubblesim.view, b = v.element.getBoundingClientRect();
            const at = (point) => { const c = point.project(v.camera);
              return [b.left + (c.x + 1) / 2 * b.width, b.top + (1 - c.y) / 2 * b.height]; };
            const place = v.camera.position.clone().set(...v.poseOf(bubblesim.selection.object).slice(0, 3));
            const rings = v.gizmo.helper.children.find((e) => e.gizmo).gizmo.rotate.children;
            const edge = place.clone().setX(place.x + 0.5 * rings.find((e) => e.name === "Z").scale.x);
            const [c, e] = [at(place), at(edge)];
            return [c, e[0] - c[0]]; })()"""
        )

        def to(degrees: float) -> None:
            angle = math.radians(degrees)
            page.page.mouse.move(centre[0] + radius * math.cos(angle), centre[1] - radius * math.sin(angle))

        page.js(NOTE_LINES)
        to(30)  # there is no other ring
        page.wait("bubblesim.view.gizmo.isBusy")
        page.page.mouse.down()
        for degrees in range(35, 75, 5):
            to(degrees)
        page.page.mouse.up()
        page.wait("bubblesim.editing.done.length === 1")
        after = page.call("window.get_state", page.js("bubblesim.selection.object.handle"))["pose"]
        turned = math.degrees(2 * math.atan2(after[5], after[6]) - 2 * math.atan2(before[5], before[6]))
        assert turned == pytest.approx(15 * round(turned / 15), abs=0.01)
        assert 15 <= turned <= 60
        assert page.js("bubblesim.lines.size") == 1  # calls on several have no order: the last pose might not stay


def test_control_and_a_drag_lift_a_body(tmp_path: Path, show: Show) -> None:
    with Node(tmp_path, str(write(tmp_path / "box.sdf", BOX))) as node:
        page = show(node)
        page.look_at("/box")
        page.zoom_out(4)
        page.js("bubblesim.view.settled()")
        x, y = page.middle()
        page.wait("bubblesim.view.picker.pick(...x)?.link.path === '/box/link'", [x, y])
        height = "bubblesim.view.poseOf(bubblesim.scene.byPath('/box'))[2]"
        # Another call of the page does not hold it up.
        page.js("void bubblesim.link.call('sim.wait', [2]).catch(() => 0)")
        page.page.keyboard.down("Control")
        page.page.mouse.move(x, y)
        page.page.mouse.down()
        page.page.mouse.move(x, y - 150, steps=5)
        page.wait(f"{height} > 0.3")
        page.page.mouse.up()
        page.page.keyboard.up("Control")
        page.wait(f"{height} < 0.2")


def test_the_mouse_pulls_a_body_that_runs(tmp_path: Path, show: Show) -> None:
    with Node(tmp_path, "ball") as node:
        page = show(node)
        ball = page.js("bubblesim.scene.byPath('/Ball').handle")
        link = page.js("bubblesim.scene.byPath('/Ball').children.find(e => e.kind === 'link').handle")
        start = page.call("window.get_state", ball)["pose"]
        page.call("window.grip", link, [0, 0, 0])
        page.call("window.pull", [start[0], start[1], start[2] + 2])
        page.wait("bubblesim.view.poseOf(bubblesim.scene.byPath('/Ball'))[2] > x", start[2] + 1)
        page.call("window.let_go")
        page.wait("bubblesim.view.poseOf(bubblesim.scene.byPath('/Ball'))[2] < x", start[2] + 0.5)


def test_a_model_of_the_folders_is_added(tmp_path: Path, show: Show) -> None:
    with Node(tmp_path, "tricycle", "--paused") as node:
        page = show(node)
        page.js("bubblesim.layout.show('models')")
        page.page.locator("[data-model=chair]").scroll_into_view_if_needed()  # only what is seen gets a picture
        # The cards are there as soon as the server has listed the models, the pictures later.
        page.wait("document.querySelector('[data-model=chair] .picture')?.style.backgroundImage.includes('blob:')")
        page.page.drag_and_drop("[data-model=chair]", ".view canvas")
        page.wait("bubblesim.scene.byPath('/chair')")


def test_a_page_that_closes_lets_go_of_the_body_that_it_pulls(tmp_path: Path, show: Show) -> None:
    with Node(tmp_path, "ball") as node:
        first, second = show(node), show(node)
        height = "bubblesim.view.poseOf(bubblesim.scene.byPath('/Ball'))[2]"
        second.wait("bubblesim.link.frame.time > 2")  # it has fallen
        rest = second.js(height)
        link = first.js("[...bubblesim.scene.objects.values()].find(e => e.path.startsWith('/Ball/')).handle")
        first.call("window.grip", link, [0, 0, 0])
        second.call("window.let_go")  # of its own spring: there is none
        first.call("window.pull", [0, 0, rest + 2])
        second.wait(f"{height} > {rest + 1}")
        first.page.close()
        second.wait(f"{height} < {rest + 0.1}")
