# SPDX-License-Identifier: BSD-3-Clause
"""The types of ROS 2: hashes and bytes are those of ROS 2 itself."""

import json
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from bubblesim import _core
from bubblesim.messages.packages import PackageIndex
from bubblesim.messages.ros2_definitions import read_parts
from bubblesim.messages.ros2_hashes import message_hash, service_hash
from bubblesim.messages.ros2_specs import Ros2Specs, own_definitions
from ros2_peer import PEERS, Ros2Peer, has_ros2

codec = _core.messages
ROS1, ROS2 = codec.RosVersion.ROS1, codec.RosVersion.ROS2
SHARE = PEERS / "share"

pytestmark = has_ros2


def golden_hashes() -> dict[str, str]:
    """Return hash by `package/folder/Type`, of the descriptions that ROS 2's packages have with their definitions."""
    hashes: dict[str, str] = {}
    for file in SHARE.glob("*/*/*.json"):
        for entry in json.loads(file.read_text()).get("type_hashes", []):
            hashes[entry["type_name"]] = entry["hash_string"]
    return hashes


def definitions(folder: str) -> list[Path]:
    return [file for file in sorted(SHARE.glob(f"*/{folder}/*.{folder}")) if file.with_suffix(".json").exists()]


@pytest.fixture(scope="module")
def golden() -> dict[str, str]:
    if not SHARE.exists():
        pytest.skip("rclpy is not installed: scripts/setup --with ros2 --with tests")
    return golden_hashes()


def test_the_hash_of_each_definition_of_ros2_is_ros2s(golden: dict[str, str]) -> None:
    messages = {
        f"{file.parents[1].name}/{file.stem}": read_parts(
            file.read_text(), f"{file.parents[1].name}/{file.stem}", "msg"
        )[0]
        for file in sorted(SHARE.glob("*/msg/*.msg"))
    }
    found = {message.full_name: message_hash(message, messages.__getitem__) for message in messages.values()}
    for file in definitions("srv"):
        name = f"{file.parents[1].name}/{file.stem}"
        parts = read_parts(file.read_text(), name, "srv")
        found[name.replace("/", "/srv/")] = service_hash(name, *parts, messages.__getitem__)
    compared = found.keys() & golden.keys()
    assert len(compared) > 150
    assert {name for name in compared if found[name] != golden[name]} == set()


def test_the_types_of_this_build_have_ros2s_hashes(golden: dict[str, str]) -> None:
    messages = {name.replace("/", "/msg/"): codec.type_hash(name, ROS2) for name in codec.message_names(ROS2)}
    services = {name.replace("/", "/srv/"): codec.service_type_hash(name, ROS2) for name in codec.service_names(ROS2)}
    compared = (messages | services).keys() & golden.keys()
    assert len(compared) > 100
    assert {name for name in compared if (messages | services)[name] != golden[name]} == set()


@pytest.mark.parametrize("action", ["test_msgs/Fibonacci", "test_msgs/NestedMessage"])
def test_the_parts_of_actions_have_ros2s_hashes(golden: dict[str, str], action: str) -> None:
    index = PackageIndex()
    index.add_share(SHARE)
    specs = Ros2Specs(index, own_definitions(before_iron=False))
    base = specs.load_action(action)
    messages = {message.full_name: specs.message_hash(message) for message in specs.messages.values()}
    services = {name: specs.service_hash(name) for name in specs.services}
    halves = {half.full_name: specs.message_hash(half) for parts in specs.services.values() for half in parts}
    found = {name: value for name, value in (messages | services | halves).items() if name.startswith(base)}
    assert len(found) == 10
    assert {name for name in found if found[name] != golden[name]} == set()


def test_ros2_lacks_what_is_ros1s_alone() -> None:
    assert {"std_msgs/Time", "rosgraph_msgs/Log", "nav_msgs/GetMapActionGoal"} <= set(codec.message_names(ROS1))
    assert not {"std_msgs/Time", "rosgraph_msgs/Log", "nav_msgs/GetMapActionGoal"} & set(codec.message_names(ROS2))


def test_fields_follow_each_side() -> None:
    assert list(codec.fields("std_msgs/Header", ROS1)) == ["seq", "stamp", "frame_id"]
    assert list(codec.fields("std_msgs/Header", ROS2)) == ["stamp", "frame_id"]
    assert {"d", "k", "r", "p"} < codec.fields("sensor_msgs/CameraInfo", ROS2).keys()
    assert {"D", "K", "R", "P"} < codec.fields("sensor_msgs/CameraInfo", ROS1).keys()
    assert "variance" in codec.fields("sensor_msgs/Range", ROS2)


@pytest.mark.parametrize(
    ("name", "message", "version", "hint"),
    [
        ("std_msgs/Header", {"seq": 1}, ROS2, "in ROS 1 it has 'seq'"),
        ("sensor_msgs/CameraInfo", {"K": [0.0] * 9}, ROS2, "in ROS 1 it has 'K'"),
        ("sensor_msgs/CameraInfo", {"k": [0.0] * 9}, ROS1, "in ROS 2 it has 'k'"),
    ],
)
def test_a_field_of_the_other_side_is_named(name: str, message: Any, version: Any, hint: str) -> None:
    with pytest.raises(codec.MessageError, match=hint):
        (codec.encode_ros2 if version == ROS2 else codec.encode)(name, message)


def test_more_than_a_bound_allows_is_refused(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Of ROS 2, rclpy and Fast DDS refuse it, too."""
    (tmp_path / "bounded_msgs" / "msg").mkdir(parents=True)
    (tmp_path / "bounded_msgs" / "package.xml").write_text("<package><name>bounded_msgs</name></package>")
    definition = "float64[<=3] numbers\nstring<=5 text\nstring<=2[<=1] names\nstd_msgs/Bool[<=1] flags\n"
    (tmp_path / "bounded_msgs" / "msg" / "Bounded.msg").write_text(definition)
    monkeypatch.setenv("ROS_PACKAGE_PATH", str(tmp_path))
    name = "bounded_msgs/Bounded"
    largest = {"numbers": [1.0, 2.0, 3.0], "text": "fünf", "names": ["ab"], "flags": [{"data": True}]}
    decoded = codec.decode_ros2(name, codec.encode_ros2(name, largest))
    assert {**decoded, "numbers": list(decoded["numbers"])} == largest
    for field, value, expected in [
        ("numbers", np.arange(4.0), "numbers: expected at most 3 elements, found 4"),
        ("numbers", [1.0] * 4, "numbers: expected at most 3 elements, found 4"),
        ("text", "sechs6", "text: expected at most 5 bytes, found 6"),
        ("names", ["abc"], r"names\[0\]: expected at most 2 bytes, found 3"),
        ("names", ["a", "b"], "names: expected at most 1 elements, found 2"),
        ("flags", [{}, {}], "flags: expected at most 1 elements, found 2"),
    ]:
        with pytest.raises(codec.MessageError, match=expected):
            codec.encode_ros2(name, {field: value})


HEADER = {"stamp": {"sec": 12, "nanosec": 34}, "frame_id": "map"}
MESSAGES: dict[str, dict[str, Any]] = {
    "std_msgs/Bool": {"data": True},
    "std_msgs/Byte": {"data": 200},
    "std_msgs/Char": {"data": 65},
    "std_msgs/ColorRGBA": {"r": 0.5, "g": 0.25, "b": 1.0, "a": 0.0},
    "std_msgs/Empty": {},
    "std_msgs/Float32": {"data": 1.5},
    "std_msgs/Float32MultiArray": {
        "layout": {"dim": [{"label": "x", "size": 2, "stride": 2}], "data_offset": 1},
        "data": [1.5, -2.5],
    },
    "std_msgs/Float64": {"data": -0.1},
    "std_msgs/Float64MultiArray": {"data": [0.1, 0.2, 0.3]},
    "std_msgs/Header": HEADER,
    "std_msgs/Int16": {"data": -300},
    "std_msgs/Int32MultiArray": {"data": [1, -2, 3]},
    "std_msgs/Int64": {"data": -(2**60)},
    "std_msgs/Int8": {"data": -5},
    "std_msgs/String": {"data": "grüße"},
    "std_msgs/UInt16": {"data": 60000},
    "std_msgs/UInt64": {"data": 2**63},
    "std_msgs/UInt8MultiArray": {"data": b"\x01\x02\xff"},
    "geometry_msgs/Accel": {"linear": {"x": 1.0}, "angular": {"z": 2.0}},
    "geometry_msgs/Point32": {"x": 0.5, "y": 1.5, "z": 2.5},
    "geometry_msgs/PolygonStamped": {
        "header": HEADER,
        "polygon": {"points": [{"x": 1.0, "y": 2.0, "z": 3.0}, {"x": 4.0, "y": 5.0, "z": 6.0}]},
    },
    "geometry_msgs/PoseArray": {
        "header": HEADER,
        "poses": [
            {"position": {"x": 1.0, "y": 2.0, "z": 3.0}, "orientation": {"x": 0.0, "y": 0.0, "z": 0.0, "w": 1.0}}
        ],
    },
    "geometry_msgs/TransformStamped": {
        "header": HEADER,
        "child_frame_id": "base_link",
        "transform": {
            "translation": {"x": 1.0, "y": 2.0, "z": 3.0},
            "rotation": {"x": 0.0, "y": 0.0, "z": 0.0, "w": 1.0},
        },
    },
    "geometry_msgs/Twist": {"linear": {"x": 0.5, "y": 0.0, "z": 0.0}, "angular": {"x": 0.0, "y": 0.0, "z": -1.0}},
    "geometry_msgs/Vector3Stamped": {"header": HEADER, "vector": {"x": 1.0, "y": 2.0, "z": 3.0}},
    "geometry_msgs/WrenchStamped": {"header": HEADER, "wrench": {"force": {"x": 1.0}, "torque": {"y": 2.0}}},
    "nav_msgs/OccupancyGrid": {
        "header": HEADER,
        "info": {
            "map_load_time": {"sec": 1, "nanosec": 2},
            "resolution": 0.5,
            "width": 3,
            "height": 1,
            "origin": {"orientation": {"x": 0.0, "y": 0.0, "z": 0.0, "w": 1.0}},
        },
        "data": [-1, 0, 100],
    },
    "nav_msgs/Odometry": {
        "header": HEADER,
        "child_frame_id": "base",
        "pose": {"pose": {"orientation": {"x": 0.0, "y": 0.0, "z": 0.0, "w": 1.0}}, "covariance": [0.5] * 36},
        "twist": {"twist": {"linear": {"x": 1.0}}, "covariance": [0.25] * 36},
    },
    "sensor_msgs/BatteryState": {"header": HEADER, "voltage": 12.5, "cell_voltage": [4.0, 4.25], "location": "rear"},
    "sensor_msgs/CameraInfo": {
        "header": HEADER,
        "height": 2,
        "width": 3,
        "distortion_model": "plumb_bob",
        "d": [0.1, 0.2],
        "k": [1.0] * 9,
        "r": [2.0] * 9,
        "p": [3.0] * 12,
        "roi": {"x_offset": 1, "do_rectify": True},
    },
    "sensor_msgs/CompressedImage": {"header": HEADER, "format": "jpeg", "data": b"\x01\x02\x03"},
    "sensor_msgs/Image": {
        "header": HEADER,
        "height": 1,
        "width": 2,
        "encoding": "rgb8",
        "is_bigendian": 0,
        "step": 6,
        "data": b"abcdef",
    },
    "sensor_msgs/Imu": {
        "header": HEADER,
        "orientation": {"x": 0.0, "y": 0.0, "z": 0.0, "w": 1.0},
        "orientation_covariance": [0.5] * 9,
        "linear_acceleration": {"z": 9.81},
    },
    "sensor_msgs/JointState": {
        "header": HEADER,
        "name": ["a", "bc"],
        "position": [1.0, 2.0],
        "velocity": [],
        "effort": [3.0, 4.0],
    },
    "sensor_msgs/Joy": {"header": HEADER, "axes": [0.5, -0.5], "buttons": [0, 1, 0]},
    "sensor_msgs/LaserScan": {
        "header": HEADER,
        "angle_min": -1.5,
        "angle_max": 1.5,
        "angle_increment": 0.5,
        "range_max": 10.0,
        "ranges": [1.0, 2.0, 3.5],
        "intensities": [],
    },
    "sensor_msgs/NavSatFix": {
        "header": HEADER,
        "status": {"status": 0, "service": 1},
        "latitude": 48.5,
        "longitude": 11.25,
        "altitude": 500.0,
        "position_covariance": [1.0] * 9,
        "position_covariance_type": 2,
    },
    "sensor_msgs/PointCloud2": {
        "header": HEADER,
        "height": 1,
        "width": 1,
        "fields": [{"name": "x", "offset": 0, "datatype": 7, "count": 1}],
        "is_bigendian": False,
        "point_step": 4,
        "row_step": 4,
        "data": b"\x00\x00\x80\x3f",
        "is_dense": True,
    },
    "sensor_msgs/Range": {"header": HEADER, "radiation_type": 1, "range": 0.5, "variance": 0.25},
    "sensor_msgs/Temperature": {"header": HEADER, "temperature": 20.5, "variance": 0.5},
    "rosgraph_msgs/Clock": {"clock": {"sec": 5, "nanosec": 6}},
    "trajectory_msgs/JointTrajectory": {
        "header": HEADER,
        "joint_names": ["j"],
        "points": [{"positions": [1.0], "velocities": [], "time_from_start": {"sec": -2, "nanosec": 5}}],
    },
    "visualization_msgs/Marker": {
        "header": HEADER,
        "ns": "n",
        "id": 7,
        "type": 5,
        "pose": {"orientation": {"x": 0.0, "y": 0.0, "z": 0.0, "w": 1.0}},
        "lifetime": {"sec": 1, "nanosec": 0},
        "points": [{"x": 1.0, "y": 2.0, "z": 3.0}],
        "colors": [{"r": 1.0, "g": 0.5, "b": 0.25, "a": 1.0}],
        "text": "t",
    },
}


def simple(value: Any) -> Any:
    """Return a message without numpy, for comparisons; bytes as lists of numbers."""
    if isinstance(value, dict):
        return {name: simple(item) for name, item in value.items()}
    if isinstance(value, np.ndarray):
        return value.tolist()
    if isinstance(value, bytes):
        return list(value)
    return [simple(item) for item in value] if isinstance(value, list) else value


def for_json(value: Any) -> Any:
    if isinstance(value, dict):
        return {name: for_json(item) for name, item in value.items()}
    return (
        [for_json(item) for item in value]
        if isinstance(value, list)
        else list(value)
        if isinstance(value, bytes)
        else value
    )


def test_at_least_forty_types_are_compared() -> None:
    assert len(MESSAGES) >= 40


def test_messages_are_understood_by_ros2_and_ros2s_are_here(ros2_peer: Ros2Peer) -> None:
    for name, message in MESSAGES.items():
        spelling = name.replace("/", "/msg/")
        theirs = ros2_peer.encode(spelling, for_json(message))
        assert theirs[:4] == b"\0\1\0\0", name
        decoded = codec.decode_ros2(name, theirs[4:], codec.TimeForm.SEC_NANOSEC)
        ours = codec.encode_ros2(name, decoded)
        assert len(theirs) - 4 >= len(ours), name  # rclpy pads to the size that it has estimated
        returned = ros2_peer.decode(spelling, theirs[:4] + ours)
        assert simple(decoded) == simple(returned), name
        assert_contains(simple(decoded), simple(message), name)


def assert_contains(whole: Any, part: Any, place: str) -> None:
    """Assert that a message has these values, among others."""
    if isinstance(part, dict):
        for name, value in part.items():
            assert_contains(whole[name], value, f"{place}.{name}")
    elif isinstance(part, list) and part and isinstance(part[0], dict):
        assert len(whole) == len(part), place
        for i, (left, right) in enumerate(zip(whole, part, strict=True)):
            assert_contains(left, right, f"{place}[{i}]")
    else:
        assert whole == pytest.approx(part) if isinstance(part, float | list) and part else whole == part, place
