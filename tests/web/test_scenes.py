# SPDX-License-Identifier: BSD-3-Clause
"""The scenes of the tutorials in the page, in a real browser."""

import shutil
from collections.abc import Callable
from pathlib import Path

import pytest

from web_support import Node, Window

Show = Callable[..., Window]

SCENES = Path(__file__).parents[2] / "scenes"
EYE = """\
<model name="eye"><static>true</static><pose>{pose}</pose><link name="link">
  <sensor name="camera" type="camera"><update_rate>20</update_rate><camera>
    <horizontal_fov>1.2</horizontal_fov>
    <image><width>320</width><height>240</height></image><clip><near>0.1</near><far>50</far></clip>
  </camera></sensor>
</link></model>
</world>"""

LOOK_AT_ALL = """(async () => {
  const { scene, selection } = bubblesim;
  const heading = () => document.querySelector(".properties h2").textContent;
  const wrong = [];
  for (const object of scene.objects.values()) {
    selection.select(object);
    if (heading() !== object.name) wrong.push(object.path);
  }
  return wrong;
})()"""


@pytest.mark.parametrize("scene", ["tricycle", "bubblerob", "pioneer", "sensors"])
def test_a_scene_runs_with_all_that_can_be_shown(tmp_path: Path, show: Show, scene: str) -> None:
    with Node(tmp_path, scene) as node:
        page = show(node)
        assert page.js(LOOK_AT_ALL) == []
        for overlay in page.js("bubblesim.view.overlays.map(({ id }) => id)"):
            page.js("bubblesim.view.setOverlay(x, true)", overlay)
        for sensor in page.js(
            "[...bubblesim.scene.objects.values()].filter((e) => e.kind === 'sensor').map((e) => e.path)"
        ):
            page.select(sensor)
            page.wait("document.querySelector('.properties').textContent.includes('time')")
        before = page.js("bubblesim.link.frame.time")
        page.wait("bubblesim.link.frame.time > x + 0.2", before)
        page.button("Stop").click()
        page.wait("bubblesim.link.frame.time === 0")


@pytest.mark.parametrize(("scene", "pose"), [("bubblerob", "-1.5 -1 1 0 0.5 0.6"), ("pioneer", "-2.5 -2 2 0 0.6 0.8")])
def test_the_picture_is_that_of_a_camera_that_was_added(tmp_path: Path, show: Show, scene: str, pose: str) -> None:
    shutil.copy(SCENES / f"{scene}.py", tmp_path)
    text = (SCENES / f"{scene}.sdf").read_text().replace("</world>", EYE.format(pose=pose))
    file = tmp_path / f"{scene}_seen.sdf"
    file.write_text(text)
    with Node(tmp_path, str(file), "--paused") as node:
        page = show(node)
        assert page.difference_from_camera() < 0.02
