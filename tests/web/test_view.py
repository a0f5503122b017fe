# SPDX-License-Identifier: BSD-3-Clause
"""The 3D view: its camera, and what is drawn over the scene, in a real browser."""

from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest

from node_support import write
from web_support import Node, Window

Show = Callable[..., Window]

CAMERA = "bubblesim.view.camera.position.toArray()"
TARGET = "bubblesim.view.viewpoint.controls.target.toArray()"
AWAY = "bubblesim.view.camera.position.clone().sub(bubblesim.view.viewpoint.controls.target)"
LAYER = "bubblesim.view.overlays.find((e) => e.id === '{}').layer.object3d"


def look(page: Window) -> tuple["np.ndarray[tuple[int], np.dtype[np.float64]]", float]:
    """Return the unit vector from what is looked at to the camera, and its distance in m."""
    away = np.subtract(page.js(CAMERA), page.js(TARGET))
    distance = float(np.linalg.norm(away))
    return away / distance, distance


def test_the_camera_turns_shifts_zooms_and_looks_from_the_sides(tmp_path: Path, show: Show) -> None:
    with Node(tmp_path, "tricycle", "--paused") as node:
        page = show(node)
        mouse, keys = page.page.mouse, page.page.keyboard
        x, y = page.middle()
        before, distance = look(page)
        mouse.move(x, y)
        mouse.down()
        mouse.move(x + 100, y, steps=4)
        mouse.up()
        page.wait(f"Math.abs({CAMERA}[0] - x) > 0.3", float(before[0] * distance + page.js(TARGET)[0]))
        turned, same = look(page)
        assert same == pytest.approx(distance, rel=1e-3)
        assert turned @ before < 0.99
        target = page.js(TARGET)
        mouse.down(button="right")
        mouse.move(x + 200, y, steps=4)
        mouse.up(button="right")
        page.wait(f"Math.hypot({TARGET}[0] - x[0], {TARGET}[1] - x[1]) > 0.1", target)
        mouse.wheel(0, -300)
        page.wait(f"{AWAY}.length() < x", 0.95 * distance)
        for key, direction in (("7", [0, 0, 1]), ("1", [1, 0, 0]), ("3", [0, -1, 0])):
            keys.press(key)
            page.wait(f"{AWAY}.normalize().distanceTo({{ x: x[0], y: x[1], z: x[2] }}) < 0.01", direction)


def test_a_double_click_shows_the_object_from_near(tmp_path: Path, show: Show) -> None:
    with Node(tmp_path, "tricycle", "--paused") as node:
        page = show(node)
        page.look_at("/Tricycle")
        page.zoom_out(2)
        page.wait("bubblesim.view.picker.pick(...x)?.link.path.startsWith('/Tricycle')", page.middle())
        page.page.mouse.dblclick(*page.middle())
        page.is_near("/Tricycle")


def test_the_camera_follows_what_moves(tmp_path: Path, show: Show) -> None:
    with Node(tmp_path, "ball") as node:
        page = show(node)
        page.select("/Ball")
        page.page.keyboard.press("f")
        page.wait("bubblesim.view.viewpoint.following?.path === '/Ball/link'")
        place = "[...bubblesim.view.poseOf(bubblesim.view.viewpoint.following)].slice(0, 3)"
        both = f"bubblesim.view.settled().then(() => [{CAMERA}, {place}])"
        camera, ball = page.js(both)
        page.wait(f"Math.hypot(...{place}.map((e, i) => e - x[i])) > 1", ball)
        camera_now, ball_now = page.js(both)
        assert np.subtract(camera_now, camera) == pytest.approx(np.subtract(ball_now, ball), abs=1e-3)
        page.page.keyboard.press("f")
        page.wait("bubblesim.view.viewpoint.following === null")


SCENE = """\
<sdf version="1.9">
  <world name="overlays">
    <gravity>0 0 0</gravity>
    <model name="body"><pose>1 2 3 0 0 1.5707963267948966</pose><link name="link">
      <inertial><pose>0.25 0 0 0 0 0</pose><mass>1</mass></inertial>
      <collision name="c"><pose>0.5 0 0 0 0 0</pose><geometry><box><size>1 2 3</size></box></geometry></collision>
    </link></model>
    <model name="wall"><static>true</static><pose>2.5 0 0 0 0 0</pose><link name="link">
      <collision name="c"><geometry><box><size>1 20 2</size></box></geometry></collision>
    </link></model>
    <model name="mast"><static>true</static><link name="link">
      <sensor name="lidar" type="gpu_lidar"><update_rate>20</update_rate><pose>0.5 0 0 0 0 0</pose><lidar>
        <scan><horizontal><samples>11</samples><min_angle>-1</min_angle><max_angle>1</max_angle></horizontal></scan>
        <range><min>0.1</min><max>30</max></range>
      </lidar></sensor>
    </link></model>
    <model name="door"><pose>-5 0 0 0 0 0</pose>
      <link name="frame"/>
      <link name="leaf"><pose>0 1 0 0 0 0</pose></link>
      <joint name="hinge" type="revolute"><parent>frame</parent><child>leaf</child>
        <axis><xyz>0 1 0</xyz><limit><lower>-1</lower><upper>2</upper></limit></axis></joint>
    </model>
  </world>
</sdf>
"""
POINTS = """((object) => {
  object.updateMatrixWorld(true);
  const points = [];
  object.traverse((each) => {
    const place = each.geometry?.attributes.position;
    if (!place) return;
    for (let copy = 0; copy < (each.count ?? 1); ++copy) {
      const pose = each.matrixWorld.clone();
      if (each.isInstancedMesh) pose.multiply(pose.clone().fromArray(each.instanceMatrix.array, 16 * copy));
      for (let i = 0; i < place.count; ++i) {
        points.push(bubblesim.view.camera.position.clone().fromBufferAttribute(place, i).applyMatrix4(pose).toArray());
      }
    }
  });
  return points;
})"""


def test_what_is_drawn_over_the_scene_is_in_its_place(tmp_path: Path, show: Show) -> None:
    with Node(tmp_path, str(write(tmp_path / "overlays.sdf", SCENE)), "--paused") as node:
        page = show(node)
        page.button("One step").click()
        page.wait("bubblesim.link.frame.time > 0")

        def points_of(overlay: str) -> "np.ndarray[tuple[int, ...], np.dtype[np.float64]]":
            page.js("bubblesim.view.setOverlay(x, true)", overlay)
            page.wait(f"{POINTS}({LAYER.format(overlay)}).length > 0")
            page.js("bubblesim.view.settled()")
            return np.array(page.js(f"{POINTS}({LAYER.format(overlay)})"))

        rays = points_of("points")
        assert rays[:, 0] == pytest.approx(2, abs=1e-4)  # the front of the wall
        assert rays[:, 1] == pytest.approx(1.5 * np.tan(np.linspace(-1, 1, 11)), abs=1e-4)
        ball = points_of("centres")
        middle = (ball.reshape(3, -1, 3).max(axis=1) + ball.reshape(3, -1, 3).min(axis=1)) / 2  # of three links
        assert any(np.allclose(each, [1, 2.25, 3], atol=1e-6) for each in middle)
        axis = points_of("joints")
        assert axis.mean(axis=0) == pytest.approx([-5, 1, 0], abs=1e-2)
        assert np.ptp(axis[:, 1]) == pytest.approx(0.32, abs=1e-6)  # along y
        ends = points_of("frames")
        assert any(np.allclose(end, [1, 2.24, 3], atol=1e-6) for end in ends)  # the x axis of the body, which is turned
        corners = points_of("collisions")
        assert any(np.allclose(corner - [1, 2.5, 3], [1, 0.5, 1.5], atol=1e-6) for corner in corners)


def test_the_path_is_that_of_the_model(tmp_path: Path, show: Show) -> None:
    with Node(tmp_path, "ball") as node:
        page = show(node)
        page.wait(f"{LAYER.format('paths')}.children[0]?.geometry.drawRange.count > 10")
        page.call("window.pause")
        page.wait("bubblesim.link.frame.state === 'paused'")
        line = f"(({{ children: [{{ geometry }}] }}) => geometry)({LAYER.format('paths')})"
        points = f"[...{line}.attributes.position.array.slice(0, 3 * {line}.drawRange.count)]"
        path = np.reshape(page.js(points), (-1, 3))
        ball = page.call("window.get_state", page.js("bubblesim.scene.byPath('/Ball').handle"))["pose"]
        assert np.linalg.norm(path[-1, :2] - ball[:2]) < 0.011  # the points have at least 1 cm between them


HIDDEN = """<sdf version="1.9"><world name="w">
<model name="Robot"><pose>0 0 0.2 0 0 0</pose><link name="link"><visual name="v">
  <geometry><sphere><radius>0.2</radius></sphere></geometry>
  <material><diffuse>1 0 0</diffuse></material></visual></link></model>
<model name="Wall"><static>true</static><pose>0.6 -0.76 0.5 0 0 0.67</pose><link name="link"><visual name="v">
  <geometry><box><size>2 0.05 1</size></box></geometry>
  <material><diffuse>0 0 1</diffuse></material></visual></link></model>
<gravity>0 0 0</gravity></world></sdf>"""
SHARE_OF_RED = """(() => {
  const { view, scene } = bubblesim;
  const canvas = view.draw();
  const copy = new OffscreenCanvas(canvas.width, canvas.height).getContext("2d");
  copy.drawImage(canvas, 0, 0);
  const place = view.camera.position.clone().fromArray(view.poseOf(scene.byPath("/Robot"))).project(view.camera);
  const [x, y] = [(place.x + 1) * canvas.width / 2, (1 - place.y) * canvas.height / 2].map(Math.round);
  const { data } = copy.getImageData(x - 4, y - 4, 8, 8);
  let red = 0;
  for (let i = 0; i < data.length; i += 4) red += data[i] > 2 * data[i + 2];
  return red / 64;
})()"""


def test_a_robot_is_seen_through_the_wall_that_hides_it(tmp_path: Path, show: Show) -> None:
    with Node(tmp_path, str(write(tmp_path / "hidden.sdf", HIDDEN)), "--paused") as node:
        page = show(node)
        assert page.js(SHARE_OF_RED) == 0.75
        page.js("bubblesim.view.setSeeThrough(false)")
        assert page.js(SHARE_OF_RED) == 0
        page.js("bubblesim.view.setSeeThrough(true)")
        page.select("/Wall")
        assert page.js(SHARE_OF_RED) == 0.75  # of what stands, nothing is looked for
        page.js("bubblesim.view.viewpoint.camera.position.set(-1, 1.2, 1)")
        assert page.js(SHARE_OF_RED) == 1  # nothing hides it
