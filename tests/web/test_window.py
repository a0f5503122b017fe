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
from web_support import TOKEN, Node, Window

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
        page.look_at("/Tricycle")
        page.wait("bubblesim.view.picker.pick(...x)?.link.path.startsWith('/Tricycle')", page.middle())
        page.page.mouse.click(*page.middle())
        page.wait("bubblesim.selection.object?.path === '/Tricycle'")
        page.wait("document.querySelector('.properties h2').textContent === 'Tricycle'")
        page.wait("document.querySelector('.properties input[title=\"x, m\"]').value !== ''")
        page.page.locator(".search").first.fill("front")
        page.wait("[...document.querySelectorAll('.treerow')].every(e => /front/i.test(e.dataset.path))")
        page.page.locator(".treerow", has_text="FrontMotor").first.click()
        page.wait("bubblesim.selection.object.path.endsWith('FrontMotor')")
        page.wait("document.querySelector('.properties').textContent.includes('Motor effort')")


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
        remote_port, port = node.find(r"tcp://127.0.0.1:(\d+)\s"), free_port()
        command = ["bubblesim", "view", "--remote", remote_port, "--port", str(port)]

        def start_server() -> "subprocess.Popen[str]":
            with (tmp_path / "view.err").open("w") as log:
                server = start(command, os.environ | TOKEN, stderr=log)
            wait_until(lambda: "the window is at" in (tmp_path / "view.err").read_text(), "the server")
            return server

        server = start_server()
        page = show(f"http://127.0.0.1:{port}/#token=t")
        page.may_lose_server = True
        os.kill(server.pid, signal.SIGKILL)
        server.wait()
        page.wait("!bubblesim.link.connected")
        page.page.locator(".lost").wait_for(state="visible")
        server = start_server()
        page.wait("bubblesim.link.connected && bubblesim.scene.models.length === 3")
        stop(server)
        page.wait("!bubblesim.link.connected")


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
        page.may_lose_server = True
        page.button("Play").click()
        page.wait("bubblesim.link.frame.time > 1.8 || !bubblesim.scene.info || !bubblesim.link.connected")
        assert node.process.wait(60) == 0
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


def test_the_first_error_of_what_is_asked_again_and_again_is_shown(tmp_path: Path, show: Show) -> None:
    with Node(tmp_path, "ball") as node:
        page = show(node)
        page.page.evaluate(
            """() => {
            const { link } = bubblesim;
            const call = link.call.bind(link);
            bubblesim.test = { fails: true, failed: 0, answered: 0, shown: [] };
            bubblesim.notify = (text, level) => bubblesim.test.shown.push([text, level]);
            link.call = async (name, ...rest) => {
                if (name !== "sim.getProblems") return call(name, ...rest);
                if (bubblesim.test.fails) { bubblesim.test.failed++; throw new Error("out of order"); }
                bubblesim.test.answered++;
                return call(name, ...rest);
            };
            }"""
        )
        page.wait("bubblesim.test.failed >= 3")
        assert page.js("bubblesim.test.shown") == [["out of order", "error"]]
        page.js("bubblesim.test.fails = false")
        page.wait("bubblesim.test.answered >= 2")
        page.js("bubblesim.test.fails = true")
        page.wait("bubblesim.test.shown.length === 2")


def test_without_dialogs_the_panel_explains_what_it_shows(tmp_path: Path, show: Show) -> None:
    with Node(tmp_path, "ball", "--paused") as node:
        page = show(node).page
        page.click('.tab[data-panel="dialogs"]')
        assert page.locator(".dialogs").inner_text() == "No script has opened a dialog or a user interface."
