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


def test_work_images_and_buffers_are_computed_pixel_by_pixel(tmp_path: Path) -> None:
    (tmp_path / "camera.sdf").write_text(CAMERA)
    code = """
        import struct
        import numpy as np

        near = lambda a, b, tolerance=1e-2: np.testing.assert_allclose(a, b, atol=tolerance)

        def sysCall_init():
            eye = sim.getObject('.')
            sim.handleVisionSensor(eye)
            image = np.random.default_rng(1).uniform(0.2, 0.8, (32, 32, 3))

            def give(pixels):
                sim.setVisionSensorImg(eye, (np.clip(pixels, 0, 1) * 255 + 0.5).astype(np.uint8).tobytes())
                simVision.sensorImgToWorkImg(eye)

            def work():
                simVision.workImgToSensorImg(eye)
                return np.frombuffer(sim.getVisionSensorImg(eye)[0], np.uint8).reshape(32, 32, 3) / 255

            give(image)
            near(work(), image)
            simVision.uniformImgToWorkImg(eye, [0.1, 0.2, 0.3])
            near(work(), np.full((32, 32, 3), (0.1, 0.2, 0.3)))
            simVision.workImgToBuffer1(eye)
            give(image)
            simVision.workImgToBuffer2(eye)
            simVision.addBuffer1ToWorkImg(eye)
            near(work(), np.clip(image + (0.1, 0.2, 0.3), 0, 1))
            simVision.buffer2ToWorkImg(eye)
            simVision.subtractBuffer1FromWorkImg(eye)
            near(work(), np.clip(image - (0.1, 0.2, 0.3), 0, 1))
            simVision.buffer2ToWorkImg(eye)
            simVision.multiplyWorkImgWithBuffer1(eye)
            near(work(), image * (0.1, 0.2, 0.3))
            simVision.buffer1ToWorkImg(eye)
            near(work(), np.full((32, 32, 3), (0.1, 0.2, 0.3)))
            simVision.swapBuffers(eye)
            simVision.swapWorkImgWithBuffer1(eye)
            near(work(), image)
            simVision.horizontalFlipWorkImg(eye)
            near(work(), image[:, ::-1])
            simVision.verticalFlipWorkImg(eye)
            near(work(), image[::-1, ::-1])
            simVision.rotateWorkImg(eye, np.pi)
            near(work()[4:-4, 4:-4], image[4:-4, 4:-4])
            give(image)
            simVision.shiftWorkImg(eye, [0.25, 0], True)
            near(work(), np.roll(image, 8, axis=1))
            give(image)
            simVision.scaleAndOffsetWorkImg(eye, [-0.2] * 3, [2] * 3, [0.1] * 3)
            near(work(), np.clip((image - 0.2) * 2 + 0.1, 0, 1))
            give(image)
            simVision.normalizeWorkImg(eye)
            found = work()
            near([found.min(), found.max()], [0, 1])
            give(image)
            simVision.rectangularCutWorkImg(eye, [0.5, 0.25])
            found = work()
            near(found[12:20, 8:24], image[12:20, 8:24])
            assert not found[:11].any() and not found[:, :7].any()
            give(image)
            simVision.circularCutWorkImg(eye, 0.5)
            found = work()
            near(found[16, 10:22], image[16, 10:22])
            assert not found[:7].any() and not found[6, 6].any()
            give(image)
            simVision.matrix3x3OnWorkImg(eye, 1, 0.5, [0, 0, 0, 0, 1, 0, 0, 0, 0])
            near(work(), image / 2)
            give(image)
            simVision.matrix5x5OnWorkImg(eye, 1, 0.5, [0] * 12 + [1] + [0] * 12)
            near(work(), image / 2)
            simVision.uniformImgToWorkImg(eye, [0.4] * 3)
            simVision.sharpenWorkImg(eye)
            near(work()[4:-4, 4:-4], 0.4)
            bright = np.zeros((32, 32, 3))
            bright[:, 16:] = 1
            give(bright)
            simVision.edgeDetectionOnWorkImg(eye, 0.5)
            found = work()
            assert found[:, 15:17].any() and not found[:, :14].any() and not found[:, 18:].any()
            give(bright)
            result, packed = simVision.binaryWorkImg(eye, 0.5)
            assert result
            near(struct.unpack('3f', bytes(packed))[:2], [0.5, 0.75], 0.03)
            give(bright)
            simVision.intensityScaleOnWorkImg(eye, [1, 0, 0], [0, 1, 0])
            near([work()[4, 4], work()[4, 28]], [[1, 0, 0], [0, 1, 0]])
            simVision.uniformImgToWorkImg(eye, [0] * 3)
            simVision.workImgToBuffer1(eye)
            give(bright)
            result, packed = simVision.changedPixelsOnWorkImg(eye, 0.5)
            assert result
            simVision.sensorDepthMapToWorkImg(eye)
            near(work()[16, 16], [(2 - 0.1) / (10 - 0.1)] * 3, 0.02)  # the wall is 2 m away
            simVision.workImgToSensorDepthMap(eye)
            result, packed = simVision.velodyneDataFromWorkImg(eye, [3, 3])
            numbers = struct.unpack(f'{len(packed) // 4}f', bytes(packed))
            near([*numbers[:2], numbers[2 + 4 * 4 + 2]], [3, 3, 2], 0.02)
            try:
                simVision.handleSpherical(eye)
            except RuntimeError as error:
                assert 'lidar' in str(error)
            else:
                raise AssertionError('accepted')
    """
    scene = str(tmp_path / "camera.sdf")
    run = run_script(tmp_path, code, "--strict", scene=scene, target="/Camera/link/eye", until=0.05)
    assert (run.stderr, run.returncode) == ("", 0)
