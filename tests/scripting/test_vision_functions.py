# SPDX-License-Identifier: BSD-3-Clause
"""`sim` functions about cameras and lidars, called by scripts that check the results themselves."""

from pathlib import Path

import pytest

from node_support import in_init, run_script

HEADER = """
import numpy as np
"""

HANDLES = "camera, depth_camera, lidar = (sim.getObject(path) for path in ('/Camera', '/DepthCamera', '/Lidar'))\n"


def run(folder: Path, body: str) -> str:
    """Run `body` in sysCall_init in the scene `sensors`; return its output on stderr."""
    code = HEADER + in_init(HANDLES + body.strip("\n"))
    return run_script(folder, code, "--strict", scene="sensors", target="/Mast", until=0.1).stderr


def test_images_go_from_the_bottom_up_and_arrays_from_the_top_down(tmp_path: Path) -> None:
    body = """
data, (w, h) = sim.getVisionSensorImg(camera)
assert (w, h) == (640, 480) and sim.getVisionSensorRes(camera) == [640, 480]
picture = sim.getVisionSensorArray(camera)
assert picture.shape == (480, 640, 3)
assert data == picture[::-1].tobytes()
assert sim.getVisionSensorCharImage(camera) == (data, 640, 480)
assert sim.transformImage(data, [w, h], 4) == picture.tobytes()
assert sim.transformImage(data, [w, h], 2) == picture[::-1, ::-1].tobytes()
"""
    assert run(tmp_path, body) == ""


def test_parts_of_images_count_from_the_lower_left(tmp_path: Path) -> None:
    body = """
picture = sim.getVisionSensorArray(camera)[::-1]
assert sim.getVisionSensorImg(camera, 0, 0, [10, 20], [30, 40]) == (picture[20:60, 10:40].tobytes(), [30, 40])
assert sim.getVisionSensorCharImage(camera, 10, 20, 30, 40) == (picture[20:60, 10:40].tobytes(), 30, 40)
assert sim.getVisionSensorImg(camera, 0, 0, [600, 400], [0, 0])[1] == [40, 80]
"""
    assert run(tmp_path, body) == ""


def test_images_may_be_grey_or_show_depth(tmp_path: Path) -> None:
    body = """
picture = sim.getVisionSensorArray(camera)[::-1]
grey = np.frombuffer(sim.getVisionSensorImg(camera, 1)[0], np.uint8).reshape(480, 640)
assert np.abs(grey - picture.mean(axis=2)).max() <= 0.5
depth = np.array(sim.unpackFloatTable(sim.getVisionSensorDepth(camera)[0])).reshape(480, 640)
four = np.frombuffer(sim.getVisionSensorImg(camera, 0, 0.15)[0], np.uint8).reshape(480, 640, 4)
assert (four[:, :, :3] == picture).all()
assert set(np.unique(four[:, :, 3])) == {0, 255}
assert ((four[:, :, 3] == 255) == (depth < 0.15)).mean() > 0.999
"""
    assert run(tmp_path, body) == ""


def test_depths_are_metres_or_parts_of_the_clipping_range(tmp_path: Path) -> None:
    body = """
data, size = sim.getVisionSensorDepth(depth_camera, 1)
metres = np.array(sim.unpackFloatTable(data)).reshape(48, 64)
assert size == [64, 48]
off = 23.5 / (32 / np.tan(0.65))  # outer rows off the axis, which points down by 0.25 rad, 1 m above the floor
np.testing.assert_allclose(metres[0, 32], 1 / (np.sin(0.25) + off * np.cos(0.25)), atol=1e-4)
np.testing.assert_allclose(metres[-1, 32], 4 / (np.cos(0.25) + off * np.sin(0.25)), atol=1e-4)
parts = np.array(sim.unpackFloatTable(sim.getVisionSensorDepth(depth_camera)[0])).reshape(48, 64)
np.testing.assert_allclose(0.3 + parts * (4 - 0.3), metres, atol=1e-5)
"""
    assert run(tmp_path, body) == ""


def test_statistics_are_those_of_the_picture(tmp_path: Path) -> None:
    body = """
result, packet = sim.readVisionSensor(camera)
picture = sim.getVisionSensorArray(camera) / 255
depth = np.array(sim.unpackFloatTable(sim.getVisionSensorDepth(camera)[0]))
channels = [picture.mean(axis=2), *picture.transpose(2, 0, 1), depth]
assert result == 0
np.testing.assert_allclose(packet, [of(c) for of in (np.min, np.max, np.mean) for c in channels], atol=1e-6)
assert sim.handleVisionSensor(camera) == (0, packet)
"""
    assert run(tmp_path, body) == ""


def test_objects_in_the_picture_are_found(tmp_path: Path) -> None:
    body = """
for path, seen in ('/Ball', 1), ('/Ball/link', 1), ('/Floor', 1), ('/Mast', 0):
    assert sim.checkVisionSensor(camera, sim.getObject(path))[0] == seen, path
assert sim.checkVisionSensor(camera, sim.handle_all)[0] == 1
"""
    assert run(tmp_path, body) == ""


def test_scans_are_arrays(tmp_path: Path) -> None:
    body = """
ranges = sim.readLidar(lidar)
assert ranges.shape == (1, 361)
assert abs(ranges[0, 270] - 3) < 1e-4
"""
    assert run(tmp_path, body) == ""


def test_an_imu_gives_lists(tmp_path: Path) -> None:
    body = """
orientation, angular_velocity, acceleration = sim.readImu(sim.getObject('/Imu'))
np.testing.assert_allclose(orientation, [0, 0, np.sqrt(0.5), np.sqrt(0.5)], atol=1e-9)
assert angular_velocity == [0, 0, 0]
np.testing.assert_allclose(acceleration, [0, 0, 9.8], atol=1e-9)
"""
    assert run(tmp_path, body) == ""


@pytest.mark.parametrize(
    ("call", "error"),
    [
        ("sim.getVisionSensorImg(lidar)", "/Lidar is a lidar, not a camera"),
        ("sim.readLidar(camera)", "/Camera is a camera, not a lidar"),
        ("sim.readVisionSensor(sim.getObject('/Ball'))", "/Ball is a model, not a sensor"),
        ("sim.getVisionSensorImg(depth_camera)", "/DepthCamera is a depth camera without colour image"),
        (
            "sim.getVisionSensorImg(camera, 0, 0, [600, 0], [50, 10])",
            "the part at [600, 0] of size [50, 10] exceeds the 640 x 480 pixels",
        ),
        ("sim.transformImage(b'123', [2, 2], 0)", "2 x 2 pixels need 12 bytes, found 3"),
    ],
)
def test_bad_calls_are_explained(tmp_path: Path, call: str, error: str) -> None:
    assert error in run(tmp_path, call).splitlines()[-1]
