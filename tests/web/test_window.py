# SPDX-License-Identifier: BSD-3-Clause
"""The page of the window in a real browser."""

import os
import signal
import subprocess
from collections.abc import Callable
from pathlib import Path

import pytest

from node_support import run_sim
from ros_support import free_port, start, stop, wait_until
from web_support import Node, Window

Show = Callable[..., Window]


def test_the_page_shows_the_scene_and_follows_its_state(tmp_path: Path, show: Show) -> None:
    with Node(tmp_path, "tricycle", "--paused") as node:
        page = show(node)
        assert page.page.locator(".treerow").all_inner_texts() == ["Floor", "Room", "Tricycle"]
        assert page.page.locator(".toolbar .title").inner_text() == "tricycle"
        page.wait("document.querySelector('.state').textContent === 'paused'")
        page.button("Play").click()
        page.wait("document.querySelector('.state').textContent === 'running' && bubblesim.link.frame.time > 0.3")
        page.call("sim.pauseSimulation")  # anyone
        page.wait("document.querySelector('.pause, .tool.on[title^=Pause]')")
        page.button("Stop").click()
        page.wait("document.querySelector('.state').textContent === 'stopped' && bubblesim.link.frame.time === 0")
        page.button("One step").click()
        page.wait("document.querySelector('.state').textContent === 'paused' && bubblesim.link.frame.time > 0.04")


def test_a_click_selects_and_properties_follow(tmp_path: Path, show: Show) -> None:
    with Node(tmp_path, "tricycle") as node:
        page = show(node)
        page.js("bubblesim.view.look(bubblesim.scene.byPath('/Tricycle'))")
        page.wait("bubblesim.view.pick(...x)?.link.path.startsWith('/Tricycle')", middle(page))
        page.page.mouse.click(*middle(page))
        page.wait("bubblesim.selection.object?.path === '/Tricycle'")
        page.wait("document.querySelector('.properties h2').textContent === 'Tricycle'")
        page.wait("document.querySelector('.properties input[title=\"x, m\"]').value !== ''")
        page.page.locator(".search").first.fill("front")
        page.wait("[...document.querySelectorAll('.treerow')].every(e => /front/i.test(e.dataset.path))")
        page.page.locator(".treerow", has_text="FrontMotor").first.click()
        page.wait("bubblesim.selection.object.path.endsWith('FrontMotor')")
        page.wait("document.querySelector('.properties').textContent.includes('Motor effort')")


def middle(page: Window) -> list[float]:
    box = page.page.locator(".view canvas").bounding_box()
    assert box
    return [box["x"] + box["width"] / 2, box["y"] + box["height"] / 2]


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
        page.button("Undo").click()
        page.wait("!bubblesim.scene.byPath('/Tricycle_1')")


def test_the_gizmo_moves_in_steps_of_the_grid(tmp_path: Path, show: Show) -> None:
    with Node(tmp_path, "tricycle", "--paused") as node:
        page = show(node)
        page.select("/Tricycle")
        page.js("bubblesim.view.look(bubblesim.selection.object)")
        page.page.wait_for_timeout(800)
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


def test_the_mouse_pulls_a_body_that_runs(tmp_path: Path, show: Show) -> None:
    with Node(tmp_path, "ball") as node:
        page = show(node)
        ball = page.js("bubblesim.scene.byPath('/Ball').handle")
        link = page.js("bubblesim.scene.byPath('/Ball').children.find(e => e.kind === 'link').handle")
        start = page.call("window.get_state", ball)["pose"]
        page.call("window.grip", link, start[:3])
        page.call("window.pull", [start[0], start[1], start[2] + 2])
        page.wait("bubblesim.view.poseOf(bubblesim.scene.byPath('/Ball'))[2] > x", start[2] + 1)
        page.call("window.let_go")
        page.wait("bubblesim.view.poseOf(bubblesim.scene.byPath('/Ball'))[2] < x", start[2] + 0.5)


def test_a_model_of_the_folders_is_added(tmp_path: Path, show: Show) -> None:
    with Node(tmp_path, "tricycle", "--paused") as node:
        page = show(node)
        page.js("bubblesim.layout.show('models')")
        page.wait("document.querySelector('[data-model=chair] .picture').style.backgroundImage.includes('blob:')")
        page.page.drag_and_drop("[data-model=chair]", ".view canvas")
        page.wait("bubblesim.scene.byPath('/chair')")


def test_two_pages_a_reload_and_a_page_that_closes(tmp_path: Path, show: Show) -> None:
    with Node(tmp_path, "tricycle") as node:
        first, second = show(node), show(node)
        first.button("Pause").click()
        second.wait("document.querySelector('.state').textContent === 'paused'")
        first.page.reload()
        first.wait("bubblesim.scene.models.length === 3")
        time = second.js("bubblesim.link.frame.time")
        first.page.close()
        second.button("Play").click()
        second.wait("bubblesim.link.frame.time > x", time + 0.5)


def test_the_page_comes_back_when_the_server_does(tmp_path: Path, show: Show) -> None:
    with Node(tmp_path, "tricycle", "--remote=0") as node:
        door, port = node.find(r"tcp://127.0.0.1:(\d+)\s"), free_port()
        command = ["bubblesim", "view", "--door", door, "--port", str(port), "--token", "t"]

        def start_server() -> "subprocess.Popen[str]":
            with (tmp_path / "view.err").open("w") as log:
                server = start(command, dict(os.environ), stderr=log)
            wait_until(lambda: "the window is at" in (tmp_path / "view.err").read_text(), "the server")
            return server

        server = start_server()
        page = show(f"http://127.0.0.1:{port}/?token=t")
        os.kill(server.pid, signal.SIGKILL)
        server.wait()
        page.wait("!bubblesim.link.connected")
        page.page.locator(".lost").wait_for(state="visible")
        page.errors.clear()  # of connections that were refused
        server = start_server()
        page.wait("bubblesim.link.connected && bubblesim.scene.models.length === 3")
        stop(server)
        page.wait("!bubblesim.link.connected")
        page.page.wait_for_timeout(100)
        page.errors.clear()
        page.page.close()


def test_a_scene_that_is_loaded_takes_the_place_of_the_one_before(tmp_path: Path, show: Show) -> None:
    with Node(tmp_path, "tricycle", "--paused") as node:
        page = show(node)
        for _ in range(2):
            for scene, model, other in (("ball", "/Ball", "/Tricycle"), ("tricycle", "/Tricycle", "/Ball")):
                page.call("sim.loadScene", scene)
                page.wait("bubblesim.scene.byPath(x)", model)
                assert not page.js("Boolean(bubblesim.scene.byPath(x))", other)
                page.button("Play").click()
                page.wait("bubblesim.link.frame.time > 0.3")
                page.wait("bubblesim.view.poseOf(bubblesim.scene.byPath(x)) !== undefined", model)
                page.button("Stop").click()
                page.wait("bubblesim.link.frame.time === 0")


def test_a_page_that_closes_lets_go_of_the_body_that_it_pulls(tmp_path: Path, show: Show) -> None:
    with Node(tmp_path, "ball") as node:
        first, second = show(node), show(node)
        height = "bubblesim.view.poseOf(bubblesim.scene.byPath('/Ball'))[2]"
        second.wait("bubblesim.link.frame.time > 2")  # it has fallen
        rest = second.js(height)
        link = first.js("[...bubblesim.scene.objects.values()].find(e => e.path.startsWith('/Ball/')).handle")
        first.call(
            "window.grip", link, first.js("[...bubblesim.view.poseOf(bubblesim.scene.byPath('/Ball'))].slice(0, 3)")
        )
        second.call("window.let_go")  # of its own spring: there is none
        first.call("window.pull", [0, 0, rest + 2])
        second.wait(f"{height} > {rest + 1}")
        first.page.close()
        second.wait(f"{height} < {rest + 0.1}")


def test_contact_points_are_where_bodies_touch(tmp_path: Path, show: Show) -> None:
    with Node(tmp_path, "ball") as node:
        page = show(node)
        page.wait("bubblesim.link.frame.time > 2")  # it has fallen
        page.js("bubblesim.view.setOverlay('contacts', true)")
        layer = "bubblesim.view.overlays.find(e => e.id === 'contacts').layer.object3d.geometry.attributes.position"
        page.wait(f"{layer}?.count > 0")
        assert abs(page.js(f"{layer}.array[2]")) < 0.01


def test_looking_changes_nothing(tmp_path: Path, show: Show) -> None:
    scene, until = "sensors", "2"
    alone = run_sim(scene, "--no-ros", "--until", until, "--state-hash").stdout
    with Node(tmp_path, scene, "--until", until, "--state-hash", "--paused") as node:
        page = show(node)
        for overlay in page.js("bubblesim.view.overlays.map(e => e.id)"):
            page.js("bubblesim.view.setOverlay(x, true)", overlay)
        page.js("bubblesim.selection.select([...bubblesim.scene.objects.values()].find(e => e.kind === 'sensor'))")
        page.button("Play").click()
        page.wait("bubblesim.link.frame.time > 1.8 || !bubblesim.scene.info")
        assert node.process.wait(60) == 0
        page.errors.clear()
    assert alone
    assert (tmp_path / "node.out").read_text().strip() == alone.strip()


@pytest.mark.parametrize("scene", ["tricycle", "sensors"])
def test_the_picture_is_that_of_the_simulators_camera(tmp_path: Path, show: Show, scene: str) -> None:
    with Node(tmp_path, scene, "--paused") as node:
        page = show(node)
        assert page.difference_from_camera() < 0.02


def test_two_thousand_boxes_are_drawn_from_small_frames(tmp_path: Path, show: Show) -> None:
    boxes = 2000
    scene = tmp_path / "boxes.sdf"
    models = "".join(
        f'<model name="box_{i}"><pose>{(i % 50) * 0.3} {(i // 50) * 0.3} 0.1 0 0 0</pose><link name="link">'
        '<collision name="c"><geometry><box><size>.2 .2 .2</size></box></geometry></collision>'
        '<visual name="v"><geometry><box><size>.2 .2 .2</size></box></geometry></visual></link></model>'
        for i in range(boxes)
    )
    ground = (
        '<model name="ground"><static>true</static><link name="link"><collision name="c"><geometry><plane>'
        "<normal>0 0 1</normal></plane></geometry></collision></link></model>"
    )
    scene.write_text(f'<sdf version="1.9"><world name="boxes">{ground}{models}</world></sdf>')
    with Node(tmp_path, str(scene), "--paused") as node:
        page = show(node)
        assert page.js("bubblesim.scene.models.length") == boxes + 1
        assert page.js("bubblesim.link.frame.poses.length") == 7 * boxes
        assert page.js("bubblesim.link.frame.poses.buffer.byteLength") <= 30 * boxes
        assert page.js("bubblesim.view.renderer.info.render.calls") < 40
        page.call("window.set_pose", page.js("bubblesim.scene.byPath('/box_7').handle"), [0, -3, 4, 0, 0, 0, 1])
        page.wait("bubblesim.view.poseOf(bubblesim.scene.byPath('/box_7'))[2] > 3.9")
