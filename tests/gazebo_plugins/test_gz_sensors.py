# SPDX-License-Identifier: BSD-3-Clause
"""Sensors of gz-sim are published as by ros_gz_bridge, without a plugin."""

import math
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from ros_peer import Message, Peer

WALL = 2.0  # m ahead of the sensors
HALF = math.tan(math.pi / 6)  # half the depth camera's image width at 1 m, in m


@pytest.fixture(scope="module")
def running(run: Callable[..., Any]) -> Any:
    return run(Path(__file__).with_name("gz_sensors.sdf"), "--speed", "2")


@pytest.fixture
def peer(running: Any) -> Peer:
    peer: Peer = running.peer
    return peer


def points(cloud: Message) -> np.ndarray[Any, Any]:
    """Return x, y and z, height x width x 3."""
    offsets = {field["name"]: field["offset"] for field in cloud["fields"]}
    kind = np.dtype(
        {"names": list("xyz"), "formats": ["<f4"] * 3, "offsets": [offsets[axis] for axis in "xyz"]}
        | {"itemsize": cloud["point_step"]}
    )
    array = np.frombuffer(cloud["data"], kind).reshape(cloud["height"], cloud["width"])
    return np.stack([array[axis] for axis in "xyz"], axis=2)


def depths(image: Message) -> np.ndarray[Any, Any]:
    assert image["encoding"] == "32FC1"
    return np.frombuffer(image["data"], "<f4").reshape(image["height"], image["width"])


def test_a_lidar_gives_its_scan_on_its_topic_in_its_frame(peer: Peer) -> None:
    scan = peer.next("/scan", "sensor_msgs/LaserScan")
    assert scan["header"]["frame_id"] == "laser"
    assert scan["ranges"] == pytest.approx([WALL / math.cos(0.4), WALL, WALL / math.cos(0.4)], abs=1e-3)


def test_a_lidar_of_several_rings_gives_the_scan_of_the_middle_one_and_all_points(peer: Peer) -> None:
    scan = peer.next("/rings", "sensor_msgs/LaserScan")
    across = np.linspace(-0.4, 0.4, 5)
    assert scan["ranges"] == pytest.approx(WALL / np.cos(across), abs=1e-3)
    cloud = points(peer.next("/rings/points", "sensor_msgs/PointCloud2"))
    assert cloud.shape == (3, 5, 3)
    np.testing.assert_allclose(cloud[:, :, 0], WALL, atol=1e-3)
    np.testing.assert_allclose(cloud[:, :, 1], WALL * np.tan(across)[None, :].repeat(3, 0), atol=1e-3)
    np.testing.assert_allclose(
        cloud[:, :, 2], WALL * np.tan([[-0.2], [0.0], [0.2]]) / np.cos(across)[None, :], atol=1e-3
    )


def test_a_sensor_without_a_topic_is_named_after_its_place_when_its_system_is_there(running: Any, peer: Peer) -> None:
    head = "/world/lab/model/head/link/eyes/sensor"
    scan = peer.next(f"{head}/unnamed/scan", "sensor_msgs/LaserScan")
    assert (scan["ranges"], scan["header"]["frame_id"]) == (pytest.approx([WALL], abs=1e-3), "head/eyes/unnamed")
    imu = peer.next(f"{head}/imu/imu", "sensor_msgs/Imu")
    assert imu["linear_acceleration"]["z"] == pytest.approx(9.8, abs=0.01)
    topics = running.core.state()["publishers"]
    assert not [topic for topic in topics if "silent" in topic], "the world has no system for magnetometers"
    assert not [topic for topic in topics if "old" in topic], "~ is a name of Gazebo's own transport"


def test_a_barometer_gives_the_pressure_of_its_height_above_the_sea(peer: Peer) -> None:
    pressure = peer.next("/pressure", "sensor_msgs/FluidPressure")
    assert pressure["fluid_pressure"] == pytest.approx(89876 - 11, abs=3), "1 m above the altitude of the reference"
    assert pressure["header"]["frame_id"] == "head/eyes/barometer"


def test_a_logical_camera_gives_models_and_their_poses_in_its_frame(peer: Peer) -> None:
    models = peer.next("/models", "gazebo_msgs/ModelStates")
    assert models["name"] == ["scale"]
    (pose,) = models["pose"]
    place = [pose["position"][axis] for axis in "xyz"]
    assert place == pytest.approx([5.0, 0.0, -1.0], abs=0.01), "it looks to the left"
    assert 2 * math.atan2(pose["orientation"]["z"], pose["orientation"]["w"]) == pytest.approx(-math.pi / 2, abs=0.01)


def test_a_camera_gives_pictures_and_its_optics_beside_them(peer: Peer) -> None:
    picture = peer.next("/front/image", "sensor_msgs/Image")
    assert (picture["encoding"], picture["width"], picture["height"]) == ("rgb8", 16, 8)
    assert picture["header"]["frame_id"] == "front_optical"
    info = peer.next("/front/camera_info", "sensor_msgs/CameraInfo")
    assert info["K"][0] == pytest.approx(16 / (2 * math.tan(0.5)))


def test_a_depth_camera_gives_depths_and_points_along_its_own_axes(peer: Peer) -> None:
    np.testing.assert_allclose(depths(peer.next("/depth", "sensor_msgs/Image")), WALL, atol=1e-3)
    cloud = points(peer.next("/depth/points", "sensor_msgs/PointCloud2"))
    # The upper left pixel's centre: x is forward, y to the left, z up.
    corner = [WALL, WALL * HALF * 31 / 32, WALL * HALF * 23 / 32]
    np.testing.assert_allclose(cloud[0, 0], corner, atol=1e-3)
    assert peer.next("/depth_optics", "sensor_msgs/CameraInfo")["width"] == 32


def test_an_rgbd_camera_gives_all_below_its_topic(peer: Peer) -> None:
    red, green, blue = np.frombuffer(peer.next("/kinect/image", "sensor_msgs/Image")["data"], np.uint8)[:3]
    assert blue > 50 > max(red, green)
    np.testing.assert_allclose(depths(peer.next("/kinect/depth_image", "sensor_msgs/Image")), WALL, atol=1e-3)
    cloud = points(peer.next("/kinect/points", "sensor_msgs/PointCloud2"))
    np.testing.assert_allclose(cloud[:, :, 0], WALL, atol=1e-3)
    info = peer.next("/kinect/camera_info", "sensor_msgs/CameraInfo")
    assert info["header"]["frame_id"] == "head/eyes/both"


def test_the_other_kinds_have_their_types(peer: Peer) -> None:
    fix = peer.next("/fix", "sensor_msgs/NavSatFix")
    assert (fix["latitude"], fix["longitude"], fix["altitude"]) == pytest.approx((48, 11, 501), abs=1e-6)
    assert peer.next("/height", "geometry_msgs/PointStamped")["point"]["z"] == pytest.approx(0)
    field = peer.next("/field", "sensor_msgs/MagneticField")["magnetic_field"]
    assert [field[axis] for axis in "xyz"] == pytest.approx([5.5645e-6, 22.8758e-6, -42.3884e-6])
    wrench = peer.next("/wrench", "geometry_msgs/WrenchStamped")["wrench"]
    assert abs(wrench["force"]["z"]) == pytest.approx(3 * 9.8, rel=0.01)
    states = peer.next("/touch", "gazebo_msgs/ContactsState")["states"]
    assert sum(state["total_wrench"]["force"]["z"] for state in states) == pytest.approx(2 * 9.8, rel=0.02)
