# SPDX-License-Identifier: BSD-3-Clause
"""The palette of the window, in a real browser."""

from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

from bubblesim import Simulation
from web_support import Node, Window

Show = Callable[..., Window]

SELECTED = "bubblesim.selection.object"


@pytest.fixture(autouse=True)
def _own_folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)


def add(page: Window, title: str) -> Any:
    """Press a button of the palette; return the model that is there then."""
    page.js("bubblesim.selection.select(null)")
    page.page.click(f".part:text-is('{title}')")
    page.wait(f"{SELECTED} !== null")
    return page.js(f"(({{ handle, path, static: fixed }}) => ({{ handle, path, fixed }}))({SELECTED})")


def test_a_shape_has_the_size_and_the_material_that_were_chosen(tmp_path: Path, show: Show) -> None:
    with Node(tmp_path, "ball", "--paused") as node:
        page = show(node)
        page.js("bubblesim.layout.show('build')")
        page.page.check(".build .choice:has-text('Size') input")
        for axis, size in (("x", "0.4"), ("y", "0.2"), ("z", "0.1")):
            page.page.fill(f"input[aria-label='Size along {axis}, m']", size)
        page.page.select_option("select[aria-label=Material]", "wood")
        box = add(page, "Box")
        assert box["path"] == "/Box"
        numbers = page.call("window.get_state", box["handle"])["numbers"]
        assert numbers["mass"] == pytest.approx(700 * 0.4 * 0.2 * 0.1)
        assert numbers["friction"] == pytest.approx(0.5)
        page.page.keyboard.press("Control+z")
        page.wait("!bubblesim.scene.byPath('/Box')")
        page.page.keyboard.press("Control+y")
        page.wait("bubblesim.scene.byPath('/Box')")


def test_a_part_is_dragged_into_the_view(tmp_path: Path, show: Show) -> None:
    with Node(tmp_path, "ball", "--paused") as node:
        page = show(node)
        page.js("bubblesim.layout.show('build')")
        page.page.drag_and_drop(".part:text-is('Sphere')", ".view canvas")
        page.wait("bubblesim.scene.byPath('/Sphere')")


def test_all_that_was_built_is_saved_and_loads_again(tmp_path: Path, show: Show) -> None:
    with Node(tmp_path, "ball", "--paused") as node:
        page = show(node)
        page.js("bubblesim.layout.show('build')")
        for title in page.js("[...document.querySelectorAll('.part')].map((each) => each.textContent)"):
            add(page, title)
        saved = page.call("server.saveScene", str(tmp_path), "built", False)
    simulation = Simulation(saved["file"])
    world = simulation.world
    names = {str(world.name(model)) for model in world.models}
    assert names >= {"Box", "Sphere", "Cylinder", "Cone", "Capsule", "Lamp", "Spotlight", "Hinge", "Slider", "Lidar"}
    simulation.object("/Hinge/Hinge").target_position = 1.0
    simulation.object("/Slider/Slider").target_position = 0.3
    simulation.step(60)
    assert -0.01 < simulation.object("/Box").position[2] < 0.5  # nothing has burst apart
    assert simulation.object("/Hinge/Hinge").joint_position == pytest.approx(1.0, abs=0.02)
    assert simulation.object("/Slider/Slider").joint_position == pytest.approx(0.3, abs=0.02)


def test_a_fixed_shape_stands_still_and_another_falls(tmp_path: Path, show: Show) -> None:
    with Node(tmp_path, "ball", "--paused") as node:
        page = show(node)
        page.js("bubblesim.layout.show('build')")
        loose = page.call("window.build", "box", [3, 0, 1], {})
        fixed = page.call("window.build", "box", [3, 2, 1], {"fixed": True})
        page.button("Play (Space)").click()
        page.wait("bubblesim.link.frame.time > 1")
        assert page.call("window.get_state", loose)["pose"][2] < 0.3
        assert page.call("window.get_state", fixed)["pose"][2] == pytest.approx(1.2)


def test_a_sensor_moves_with_the_link_that_carries_it(tmp_path: Path, show: Show) -> None:
    place = "[...bubblesim.view.poseOf(bubblesim.scene.byPath(x))].slice(0, 3)"
    with Node(tmp_path, "tricycle", "--paused") as node:
        page = show(node)
        page.js("bubblesim.layout.show('build')")
        page.select("/Tricycle/base_link")
        page.page.click(".part:text-is('Lidar')")
        page.wait("bubblesim.scene.byPath('/Lidar')")
        before = page.js(place, "/Lidar"), page.js(place, "/Tricycle")
        assert before[0][2] > before[1][2]
        text = page.call("window.get_scene_text", "/")
        page.button("Play (Space)").click()
        page.call(
            "window.set_joint_target",
            page.js("bubblesim.scene.byPath('/Tricycle/FrontMotor').handle"),
            0,
            "velocity",
            3,
        )
        page.wait("bubblesim.link.frame.time > 2")
        page.call("window.pause")
        page.wait("bubblesim.link.frame.state === 'paused'")
        page.js("bubblesim.view.settled()")
        after = page.js(place, "/Lidar"), page.js(place, "/Tricycle")
        distance = [sum((a - b) ** 2 for a, b in zip(*each, strict=True)) ** 0.5 for each in (before, after)]
        assert distance[1] == pytest.approx(distance[0], abs=1e-3)
        assert sum((a - b) ** 2 for a, b in zip(before[1], after[1], strict=True)) > 0.01  # it has moved
    file = tmp_path / "carried.sdf"
    file.write_text(text)
    simulation = Simulation(str(file))
    assert simulation.object("/Lidar").position == pytest.approx(before[0], abs=1e-3)


def test_a_lamp_lights_the_view_as_the_cameras(tmp_path: Path, show: Show) -> None:
    with Node(tmp_path, "tricycle", "--paused") as node:
        page = show(node)
        lights = "bubblesim.view.lights.group.children.filter((e) => e.isPointLight).map((e) => e.position.toArray())"
        before = page.js(lights)
        page.call("window.build", "lamp", [1, 2, 0], {})
        page.wait("bubblesim.scene.byPath('/Lamp')")
        page.js("bubblesim.view.settled()")
        assert page.js(lights) == [*before, pytest.approx([1, 2, 2.5])]


def test_what_cannot_be_built_is_refused(tmp_path: Path, show: Show) -> None:
    with Node(tmp_path, "ball", "--paused") as node:
        page = show(node)
        static = page.js("bubblesim.scene.byPath('/Ramp/link').handle")
        for arguments, message in (
            (["castle", [0, 0, 0], {}], "there is no part 'castle'"),
            (["box", [0, 0, 0], {"material": "cheese"}], "there is no material 'cheese'"),
            (["box", [0, 0, 0], {"size": [1, 0, 1]}], "from 0 to 10000"),
            (["box", [0, 0, 0], {"size": [1]}], "three lengths"),
            (["box", [0, 0, 0], {"colour": 1}], "no option 'colour'"),
            (["box", [0, 0, 0], {"carrier": static}], "only sensors"),
            (["camera", [0, 0, 0], {"carrier": static}], "is not a link that moves"),
        ):
            found = page.js("bubblesim.link.call('window.build', x).catch((e) => e.message)", arguments)
            assert message in str(found)


def test_a_read_only_window_builds_nothing(tmp_path: Path, show: Show) -> None:
    with Node(tmp_path, "ball", "--paused", "--web-edit=false") as node:
        page = show(node)
        page.js("bubblesim.layout.show('build')")
        assert page.js("document.querySelector('.build').inert")
        call = "bubblesim.link.call('window.build', ['box', [0, 0, 0], {}]).catch((e) => e.message)"
        assert "read-only" in page.js(call)


def test_a_material_sets_colour_and_friction_of_a_link(tmp_path: Path, show: Show) -> None:
    with Node(tmp_path, "ball", "--paused") as node:
        page = show(node)
        page.call("window.build", "box", [3, 0, 0], {})
        page.wait("bubblesim.scene.byPath('/Box/Box')")
        page.select("/Box/Box")
        before = page.call("window.get_state", page.js(f"{SELECTED}.handle"))["numbers"]
        page.wait("document.querySelectorAll('.properties select[aria-label=Material] option').length > 2")
        page.page.select_option(".properties select[aria-label=Material]", "ice")
        page.wait(f"bubblesim.scene.colours.get({SELECTED}.handle)?.[0] === 0.78")
        friction = f"bubblesim.link.call('window.get_state', [{SELECTED}.handle]).then((e) => e.numbers.friction)"
        assert page.js(friction) == pytest.approx(0.03)
        page.page.keyboard.press("Control+z")
        page.wait("bubblesim.editing.undone.length === 1")
        assert page.js(friction) == pytest.approx(before["friction"])
