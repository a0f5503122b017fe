# SPDX-License-Identifier: BSD-3-Clause
"""simVision: operations on images against their definitions, and sysCall_vision."""

import math
from pathlib import Path

import numpy as np
import pytest

from bubblesim.scripting.api.vision import work_images
from node_support import run_script


def test_edges_are_where_the_intensity_changes() -> None:
    image = np.zeros((4, 6, 3))
    image[:, 3:] = 1
    found = work_images.edges(image, 0.5)
    assert found[:, 2].all()
    assert not found[:, [0, 1, 3, 4, 5]].any()
    assert not work_images.edges(image, 1.5).any()


def test_blobs_are_connected_areas_with_their_main_axis() -> None:
    mask = np.zeros((100, 100), bool)
    mask[10:20, 10:50] = True
    mask[60:90, 70:80] = True
    labels, count = work_images.labelled(mask)
    assert count == 2
    size, angle, x, y, width, height = work_images.blob(np.argwhere(labels == 1), 100, 100)
    assert (size, x, y) == (pytest.approx(0.04), pytest.approx(0.3), pytest.approx(0.15))
    assert (angle, width, height) == (pytest.approx(0), pytest.approx(0.4), pytest.approx(0.1))
    _, angle, _, _, width, _ = work_images.blob(np.argwhere(labels == 2), 100, 100)
    assert abs(angle) == pytest.approx(math.pi / 2)
    assert width == pytest.approx(0.3)


def test_hue_saturation_and_lightness_are_those_of_colorsys() -> None:
    import colorsys

    colours = np.random.default_rng(1).uniform(size=(5, 7, 3))
    found = work_images.hsl(colours)
    for i, j in np.ndindex(5, 7):
        hue, light, saturation = colorsys.rgb_to_hls(*colours[i, j])
        np.testing.assert_allclose(found[i, j], [hue, saturation, light], atol=1e-12)


def test_an_image_that_is_rotated_by_quarter_turns_is_that_of_numpy() -> None:
    image = np.random.default_rng(1).uniform(size=(9, 9, 3))
    # Rows go up: counter-clockwise is from the first axis to the second one.
    np.testing.assert_allclose(work_images.rotated(image, math.pi / 2), np.rot90(image, -1))


CAMERA = """<sdf version="1.9"><world name="w">
  <physics type="ode"><max_step_size>0.005</max_step_size></physics>
  <model name="Camera"><static>true</static><link name="link">
    <sensor name="eye" type="camera"><always_on>1</always_on><update_rate>20</update_rate>
      <camera><horizontal_fov>1.5708</horizontal_fov><image><width>32</width><height>32</height></image>
      <clip><near>0.1</near><far>10</far></clip></camera></sensor></link></model>
  <model name="Wall"><static>true</static><pose>2.05 0 0 0 0 0</pose><link name="link">
    <visual name="v"><geometry><box><size>0.1 1 1</size></box></geometry>
      <material><ambient>1 0 0 1</ambient><diffuse>1 0 0 1</diffuse></material></visual></link></model>
</world></sdf>
"""


def test_the_script_of_a_camera_processes_its_image(tmp_path: Path) -> None:
    (tmp_path / "camera.sdf").write_text(CAMERA)
    code = """
        function sysCall_init() end
        function sysCall_vision(inData)
            local ret = {trigger = false, packedPackets = {}}
            simVision.sensorImgToWorkImg(inData.handle)
            simVision.selectiveColorOnWorkImg(inData.handle, {0, 1, 0.5}, {0.1, 0.5, 0.5}, false, true, false)
            local trigger, packet = simVision.blobDetectionOnWorkImg(inData.handle, 0.02, 0.01, false)
            simVision.workImgToSensorImg(inData.handle)
            if trigger then ret.trigger = true end
            ret.packedPackets[#ret.packedPackets + 1] = packet
            ret.packedPackets[#ret.packedPackets + 1] =
                select(2, simVision.coordinatesFromWorkImg(inData.handle, {3, 3}, false))
            print(inData.resolution[1], inData.clippingPlanes[2], inData.perspectiveOperation)
            return ret
        end
        function sysCall_cleanup()
            local result, standard, blobs, points = sim.readVisionSensor(sim.getObject('.'))
            print(result, #standard, blobs[1], blobs[2], math.abs(blobs[5] - 0.5) < 0.05,
                math.abs(blobs[7] - 0.25) < 0.05)
            print(points[1], points[2], math.abs(points[3 + 4 * 4 + 2] - 2) < 0.01)
        end
    """
    scene = str(tmp_path / "camera.sdf")
    run = run_script(tmp_path, code, "--strict", scene=scene, target="/Camera/link/eye", name="script.lua", until=0.15)
    assert run.stderr == ""
    printed = run.stdout.splitlines()
    assert printed[0] == "32\t10.0\ttrue"
    assert printed[-2:] == ["1\t15\t1.0\t6.0\ttrue\ttrue", "3.0\t3.0\ttrue"]


def test_sensing_of_a_script_that_is_not_of_a_camera_goes_on(tmp_path: Path) -> None:
    code = "function sysCall_init() end function sysCall_vision() error('never') end"
    run = run_script(tmp_path, code, "--strict", name="script.lua")
    assert (run.stderr, run.returncode) == ("", 0)
