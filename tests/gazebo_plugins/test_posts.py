# SPDX-License-Identifier: BSD-3-Clause
"""Sensors that plugins publish, and sensors that publish themselves."""

import math
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from bubblesim.geometry.rotations import matrix
from ros_peer import Message, Peer

WALL = 2.0  # m ahead of the sensors
DIRECTIONS = np.array([(a, e) for e in (-0.2, 0.0, 0.2) for a in (-0.4, -0.2, 0.0, 0.2, 0.4)])


@pytest.fixture(scope="module")
def peer(run: Callable[..., Any]) -> Peer:
    peer: Peer = run(Path(__file__).with_name("posts.sdf"), "--speed", "2").peer
    return peer


def fields(cloud: Message) -> np.ndarray[Any, Any]:
    """Return the points of a PointCloud2 by field name."""
    kinds = {4: "<u2", 7: "<f4"}
    point = np.dtype(
        {
            "names": [each["name"] for each in cloud["fields"]],
            "formats": [kinds[each["datatype"]] for each in cloud["fields"]],
            "offsets": [each["offset"] for each in cloud["fields"]],
            "itemsize": cloud["point_step"],
        }
    )
    return np.frombuffer(cloud["data"], point).reshape(cloud["height"], cloud["width"])


def on_the_wall() -> np.ndarray[Any, Any]:
    """Return the points where the rays of the block laser hit the wall."""
    across, up = DIRECTIONS.T
    return np.stack([np.full(15, WALL), WALL * np.tan(across), WALL * np.tan(up) / np.cos(across)], axis=1)


def test_a_block_laser_gives_a_cloud(peer: Peer) -> None:
    cloud = peer.next("/block", "sensor_msgs/PointCloud")
    points = [[point[axis] for axis in "xyz"] for point in cloud["points"]]
    np.testing.assert_allclose(points, on_the_wall(), atol=1e-3)
    assert cloud["channels"][0]["values"] == [7.0] * 15
    assert cloud["header"]["frame_id"] == "head"


def test_a_velodyne_gives_points_with_their_rings(peer: Peer) -> None:
    points = fields(peer.next("/velodyne", "sensor_msgs/PointCloud2"))[0]
    np.testing.assert_allclose(np.stack([points[axis] for axis in "xyz"], axis=1), on_the_wall(), atol=1e-3)
    assert points["ring"].tolist() == [0] * 5 + [1] * 5 + [2] * 5
    assert set(points["intensity"]) == {7.0}


def test_a_ray_sensor_of_ros_2_publishes_its_type_on_its_topic(peer: Peer) -> None:
    scan = peer.next("/two/scan", "sensor_msgs/LaserScan")
    assert (scan["header"]["frame_id"], len(scan["ranges"])) == ("head", 15)


def test_a_range_is_that_of_the_nearest(peer: Peer) -> None:
    message = peer.next("/range", "sensor_msgs/Range")
    assert message["range"] == pytest.approx(WALL, abs=1e-3)
    assert (message["radiation_type"], message["field_of_view"]) == (1, pytest.approx(0.2))
    assert (message["min_range"], message["max_range"]) == pytest.approx((0.1, 3.0))


def test_a_kinect_gives_depths_points_and_pictures(peer: Peer) -> None:
    depth = peer.next("/kinect/depth/image_raw", "sensor_msgs/Image")
    assert (depth["encoding"], depth["step"], depth["header"]["frame_id"]) == ("32FC1", 128, "kinect_optical")
    np.testing.assert_allclose(np.frombuffer(depth["data"], "<f4"), WALL, atol=1e-3)
    picture = np.frombuffer(peer.next("/kinect/rgb/image_raw", "sensor_msgs/Image")["data"], np.uint8)
    red, green, blue = picture.reshape(24, 32, 3)[12, 16]
    assert blue > 50 > max(red, green)
    points = fields(peer.next("/kinect/points", "sensor_msgs/PointCloud2"))
    # The outermost pixel's centre: 30 degrees minus half a pixel; in an optical frame x is to the right, y down.
    corner = points[0, 0]
    assert corner["x"] == pytest.approx(-WALL * math.tan(math.pi / 6) * 31 / 32, abs=1e-3)
    assert corner["y"] == pytest.approx(-WALL * math.tan(math.pi / 6) * 23 / 32, abs=1e-3)
    assert corner["z"] == pytest.approx(WALL, abs=1e-3)
    assert np.array(corner["rgb"]).view(np.uint32) & 0xFF == blue
    assert peer.next("/kinect/depth/camera_info", "sensor_msgs/CameraInfo")["width"] == 32


def test_a_gps_measures_the_place_on_the_earth(peer: Peer) -> None:
    fix = peer.next("/fix", "sensor_msgs/NavSatFix")
    assert (fix["latitude"], fix["longitude"], fix["altitude"]) == pytest.approx((52.0, 13.0, 31.0), abs=1e-9)
    assert fix["header"]["frame_id"] == "head"
    # With a heading of 0, x is north and y west; at 52 degrees, a degree of latitude is 111.26 km and a degree of
    # longitude 68.68 km (WGS 84).
    far = peer.next("/far/fix", "sensor_msgs/NavSatFix")
    assert far["latitude"] - 52 == pytest.approx(1.0 / 111.26, rel=1e-3)
    assert far["longitude"] - 13 == pytest.approx(2.0 / 68.68, rel=1e-3)


def test_a_compass_measures_the_field_of_the_earth(peer: Peer) -> None:
    # x is north, the field points down by 60 degrees, and the link faces west: north is on its right.
    field = peer.next("/magnetic", "sensor_msgs/MagneticField")
    felt = [field["magnetic_field"][axis] for axis in "xyz"]
    assert felt == pytest.approx([0, -5e-5 * math.cos(math.pi / 3), -5e-5 * math.sin(math.pi / 3)], abs=1e-12)
    assert field["header"]["frame_id"] == "needle"


def test_a_barometer_measures_its_height(peer: Peer) -> None:
    assert peer.next("/pressure_height", "geometry_msgs/PointStamped")["point"]["z"] == pytest.approx(102)


def test_a_stereo_head_gives_a_picture_of_each_side(peer: Peer) -> None:
    left = peer.next("/head/left/image_raw", "sensor_msgs/Image")
    right = peer.next("/head/right/image_raw", "sensor_msgs/Image")
    assert (left["width"], right["width"]) == (8, 12)
    assert left["header"]["frame_id"] == right["header"]["frame_id"] == "eyes"
    # Tx is -fx times the baseline, for the right camera only.
    for side, baseline in (("left", 0.0), ("right", 0.1)):
        matrix = peer.next(f"/head/{side}/camera_info", "sensor_msgs/CameraInfo")["P"]
        assert matrix[3] == pytest.approx(-matrix[0] * baseline)


def test_what_falls_measures_no_weight(peer: Peer) -> None:
    imu = peer.next("/falling", "sensor_msgs/Imu", count=3)
    felt = [imu["linear_acceleration"][axis] for axis in "xyz"]
    assert imu["header"]["frame_id"] == "body"
    assert felt == pytest.approx([0, 0, 0], abs=1e-6)


def test_hectors_imu_and_sonar_have_their_own_noise_and_angle(peer: Peer) -> None:
    imu = peer.next("/hector/imu", "sensor_msgs/Imu")
    assert imu["header"]["frame_id"] == "body"
    assert [imu["angular_velocity"][axis] for axis in "xyz"] == pytest.approx([0, 0, 0], abs=1e-6)
    assert imu["linear_acceleration_covariance"] == pytest.approx([0.09, 0, 0, 0, 0.09, 0, 0, 0, 0.16])
    sonar = peer.next("/hector/sonar", "sensor_msgs/Range")
    assert (sonar["header"]["frame_id"], sonar["field_of_view"]) == ("sonar_link", pytest.approx(0.2))
    assert sonar["range"] == pytest.approx(WALL, abs=1e-3)


def test_a_sensor_publishes_itself_on_its_own_topic(peer: Peer) -> None:
    scan = peer.next("/own/scan", "sensor_msgs/LaserScan")
    assert scan["header"]["frame_id"] == "head"
    assert scan["ranges"] == pytest.approx([WALL / math.cos(0.4), WALL, WALL / math.cos(0.4)], abs=1e-3)
    sonar = peer.next("/own/range", "sensor_msgs/Range")
    assert (sonar["range"], sonar["header"]["frame_id"]) == (math.inf, "sonar"), "REP 117: it looks away from the wall"
    depth = peer.next("/own/depth", "sensor_msgs/Image")
    np.testing.assert_allclose(np.frombuffer(depth["data"], "<f4"), WALL, atol=1e-3)
    fix = peer.next("/own/fix", "sensor_msgs/NavSatFix")
    assert (fix["latitude"], fix["longitude"], fix["altitude"]) == pytest.approx((0, 0, 1), abs=1e-6)
    assert peer.next("/own/height", "geometry_msgs/PointStamped")["point"]["z"] == pytest.approx(0.25)
    field = peer.next("/own/field", "sensor_msgs/MagneticField")["magnetic_field"]
    assert [field[axis] for axis in "xyz"] == pytest.approx([5.5645e-6, 22.8758e-6, -42.3884e-6])
    assert peer.next("/own/camera_info", "sensor_msgs/CameraInfo")["height"] == 6


def test_frames_of_sensors_are_published_in_those_of_their_links(peer: Peer) -> None:
    message = peer.next("/tf_static", "tf2_msgs/TFMessage")
    frames = {each["child_frame_id"]: each for each in message["transforms"]}
    assert set(frames) == {"sonar", "eye_optical"}
    sonar, eye = (frames[name]["transform"] for name in ("sonar", "eye_optical"))
    assert {each["header"]["frame_id"] for each in frames.values()} == {"head"}
    assert [sonar["rotation"][axis] for axis in "xyzw"] == pytest.approx([0, 0, 1, 0], abs=1e-6)  # half a turn
    assert [eye["translation"][axis] for axis in "xyz"] == pytest.approx([0.1, 0.2, 0.3])
    # z of the optical frame is x of the link, x is -y, y is -z (REP 103).
    columns = np.array(matrix([eye["rotation"][axis] for axis in "xyzw"])).T
    np.testing.assert_allclose(columns, [[0, -1, 0], [0, 0, -1], [1, 0, 0]], atol=1e-9)
