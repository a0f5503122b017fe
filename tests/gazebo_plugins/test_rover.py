# SPDX-License-Identifier: BSD-3-Clause
"""A robot from a URDF file with Gazebo plugins, spawned and driven through ROS."""

import math
import time
from collections.abc import Callable, Iterator
from pathlib import Path

import numpy as np
import pytest

from ros_peer import Message, Peer
from ros_support import DEADLINE, REPOSITORY, RosCore, wait_until

HERE = Path(__file__).parent
ROVER = (REPOSITORY / "scenes/models/rover/rover.urdf").read_text()
WALL = 3.0  # m ahead of the origin
LASER_AHEAD = 0.1  # m from base_link


@pytest.fixture(scope="module")
def running(run: Callable[..., object]) -> Iterator[object]:
    """Run the rover at the origin of a world with a wall."""
    world = run(HERE / "walls.sdf", "--gazebo-compat", "--speed", "4")
    spawn(world.peer, "rover", "/")
    yield world
    assert "error" not in world.node.output, world.node.output


def spawn(peer: Peer, name: str, namespace: str, y: float = 0.0) -> None:
    response = peer.call(
        "/gazebo/spawn_urdf_model",
        model_name=name,
        model_xml=ROVER,
        robot_namespace=namespace,
        initial_pose={"position": {"y": y}, "orientation": {"w": 1.0}},
    )
    assert response["success"], response["status_message"]


@pytest.fixture
def peer(running: object) -> Peer:
    """Return the peer, with the rover at its start, without commands."""
    reset(running.peer)
    return running.peer


def reset(peer: Peer) -> None:
    """Reset the world, and wait for the first odometry of a later step: the earlier ones may come after the answer."""
    peer.call("/gazebo/reset_world")
    answered = time.time()  # the stamps are of this clock, too
    peer.wait_for("/odom", "nav_msgs/Odometry", lambda odom: stamp(odom) > answered, "an odometry after the reset")


def stamp(message: Message) -> float:
    stamped = message["transforms"][0] if "transforms" in message else message
    return float(stamped["header"]["stamp"])


def position(message: Message) -> list[float]:
    return [message["pose"]["pose"]["position"][axis] for axis in "xyz"]


def yaw(message: Message) -> float:
    orientation = message["pose"]["pose"]["orientation"]
    return 2 * math.atan2(orientation["z"], orientation["w"])


def truth(peer: Peer, odom: Message) -> Message:
    """Return the true motion in the step of an odometry or a later one."""
    return peer.wait_for("/truth", "nav_msgs/Odometry", lambda each: stamp(each) >= stamp(odom), "the truth")


def of_one_step(
    peer: Peer, topic: str, message_type: str, holds: Callable[[Message], bool], what: str
) -> tuple[Message, Message]:
    """Return the first odometry for which `holds` is true, and the message of its step on another topic.

    The topics are connected at different times, and a step's message may be dropped: the queues hold one.
    """
    found: list[tuple[Message, Message]] = []

    def look() -> bool:
        others = {stamp(each): each for each in peer.received(topic, message_type)}
        odometry = [each for each in peer.received("/odom", "nav_msgs/Odometry") if stamp(each) in others]
        found.extend((each, others[stamp(each)]) for each in odometry if holds(each))
        return bool(found)

    wait_until(look, what, 3 * DEADLINE)
    return found[0]


def test_it_drives_at_the_speed_of_a_twist(peer: Peer) -> None:
    peer.next("/truth", "nav_msgs/Odometry")
    begin = time.time()
    peer.drive("/cmd_vel", 0.5, 0.0)

    def driven_by(way: float) -> tuple[Message, Message]:
        def holds(odom: Message) -> bool:
            return stamp(odom) > begin and position(odom)[0] > way

        return of_one_step(peer, "/truth", "nav_msgs/Odometry", holds, f"{way} m of driving")

    rolling, truly_rolling = driven_by(0.3)
    odom, really = driven_by(1.0)
    assert (odom["header"]["frame_id"], odom["child_frame_id"]) == ("odom", "base_link")
    assert odom["twist"]["twist"]["linear"]["x"] == pytest.approx(0.5, rel=0.01)
    driven = position(really)[0] - position(truly_rolling)[0]  # the wheels slip when it starts
    assert driven == pytest.approx(position(odom)[0] - position(rolling)[0], rel=0.01)
    assert really["twist"]["twist"]["linear"]["x"] == pytest.approx(0.5, rel=0.02)


def test_it_turns_to_the_left_for_a_positive_twist(peer: Peer) -> None:
    peer.drive("/cmd_vel", 0.0, 1.0)
    odom = peer.wait_for("/odom", "nav_msgs/Odometry", lambda message: yaw(message) > 1.0, "a turn of 1 rad")
    assert odom["twist"]["twist"]["angular"]["z"] == pytest.approx(1.0, rel=0.01)
    assert truth(peer, odom)["twist"]["twist"]["angular"]["z"] == pytest.approx(1.0, rel=0.02)


def test_its_transforms_equal_its_odometry(peer: Peer) -> None:
    odom, message = of_one_step(peer, "/tf", "tf2_msgs/TFMessage", lambda _: True, "the transforms of a step")
    assert [stamp(each) for each in peer.received("/tf")].count(stamp(odom)) == 1
    frames = {each["child_frame_id"]: each for each in message["transforms"]}
    base = frames["base_link"]
    assert base["header"]["frame_id"] == "odom"
    assert base["transform"]["translation"] == odom["pose"]["pose"]["position"]
    assert base["transform"]["rotation"] == odom["pose"]["pose"]["orientation"]
    wheel = frames["left_wheel"]
    assert wheel["header"]["frame_id"] == "base_link"
    assert wheel["transform"]["translation"] == pytest.approx({"x": 0.0, "y": 0.2, "z": 0.1}, abs=1e-3)


def test_it_publishes_the_angles_of_its_wheels(peer: Peer) -> None:
    state = peer.next("/joint_states", "sensor_msgs/JointState")
    assert state["name"] == ["right_wheel_joint", "left_wheel_joint"]
    assert state["position"] == pytest.approx([0.0, 0.0], abs=0.01)


def test_its_laser_sees_the_wall(peer: Peer) -> None:
    scan = peer.next("/scan", "sensor_msgs/LaserScan", count=2)
    assert scan["header"]["frame_id"] == "laser_link"
    assert (scan["range_min"], scan["range_max"]) == pytest.approx((0.1, 5.0))
    angles = scan["angle_min"] + scan["angle_increment"] * np.arange(181)
    assert angles[-1] == pytest.approx(scan["angle_max"])
    ranges = np.array(scan["ranges"], float)
    expected = (WALL - LASER_AHEAD) / np.cos(angles[30:151])
    seen = np.abs(np.tan(angles[30:151])) * (WALL - LASER_AHEAD) < 3.9
    np.testing.assert_allclose(ranges[30:151][seen & (expected < 5)], expected[seen & (expected < 5)], atol=0.02)
    assert ranges[0] == math.inf, "REP 117"


def test_its_camera_looks_at_the_wall(peer: Peer) -> None:
    image = peer.next("/front/image_raw", "sensor_msgs/Image")
    assert (image["width"], image["height"], image["encoding"], image["step"]) == (64, 48, "rgb8", 192)
    pixels = np.frombuffer(image["data"], np.uint8).reshape(48, 64, 3)
    red, green, blue = pixels[20, 32]
    assert red > 100 > max(green, blue)


def test_its_camera_publishes_its_optics(peer: Peer) -> None:
    info = peer.next("/front/camera_info", "sensor_msgs/CameraInfo")
    assert info["header"]["frame_id"] == "camera_link"
    # f = width / (2 tan(fov / 2)), the centre as in gazebo_ros_pkgs
    assert info["K"] == pytest.approx([32.0, 0, 32.5, 0, 32.0, 24.5, 0, 0, 1], rel=1e-6)
    assert info["P"] == pytest.approx([32.0, 0, 32.5, -32.0 * 0.07, 0, 32.0, 24.5, 0, 0, 0, 1, 0], rel=1e-6)
    assert info["distortion_model"] == "plumb_bob"


def test_its_pictures_come_compressed_too(peer: Peer) -> None:
    picture = peer.next("/front/image_raw/compressed", "sensor_msgs/CompressedImage")
    assert picture["data"].startswith(b"\xff\xd8"), "JPEG"


def test_its_imu_measures_its_weight(peer: Peer) -> None:
    imu = peer.next("/imu", "sensor_msgs/Imu", count=10)
    assert imu["header"]["frame_id"] == "base_link"
    felt = [imu["linear_acceleration"][axis] for axis in "xyz"]
    assert felt == pytest.approx([0, 0, 9.81], abs=0.1), "REP 145"


def test_a_twist_that_is_not_finite_is_left_out(running: object, peer: Peer) -> None:
    peer.drive("/cmd_vel", 0.2, 0.0)
    peer.wait_for("/odom", "nav_msgs/Odometry", lambda odom: odom["twist"]["twist"]["linear"]["x"] > 0.1, "driving")
    peer.drive("/cmd_vel", math.nan, 0.0)
    running.node.wait_for_output("Twist (nan, 0) ignored")
    assert peer.next("/odom", count=3)["twist"]["twist"]["linear"]["x"] == pytest.approx(0.2, rel=0.05)


def test_a_reset_stops_it(peer: Peer) -> None:
    peer.drive("/cmd_vel", 0.5, 0.0)
    peer.wait_for("/odom", "nav_msgs/Odometry", lambda odom: position(odom)[0] > 0.3, "driving")
    reset(peer)
    odom = peer.next("/odom", count=5)
    assert position(odom) == pytest.approx([0, 0, 0], abs=0.01)


def test_a_second_one_has_topics_and_frames_in_its_namespace_until_it_goes(running: object, peer: Peer) -> None:
    core: RosCore = running.core
    spawn(peer, "other", "/other", y=2.0)
    odom = peer.next("/other/odom", "nav_msgs/Odometry")
    assert (odom["header"]["frame_id"], odom["child_frame_id"]) == ("other/odom", "other/base_link")
    assert peer.next("/other/scan", "sensor_msgs/LaserScan")["header"]["frame_id"] == "other/laser_link"
    peer.drive("/other/cmd_vel", 0.3, 0.0)
    odom = peer.wait_for("/other/odom", "nav_msgs/Odometry", lambda message: position(message)[0] > 0.1, "driving")
    assert position(truth(peer, odom)) == pytest.approx([0, 0, 0], abs=0.01)
    assert peer.call("/gazebo/delete_model", model_name="other")["success"]
    wait_until(lambda: "/other/odom" not in core.state()["publishers"], "its topics to go")
    assert "/odom" in core.state()["publishers"]
