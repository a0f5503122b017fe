# SPDX-License-Identifier: BSD-3-Clause
"""The tutorials' scenes, as a node of ROS 2 uses them. PyPI has no tf2_msgs: of transforms the type is read."""

import time
from pathlib import Path
from typing import Any

import pytest

from node_support import Node
from ros2_peer import Domain, Ros2Peer
from ros_support import DEADLINE

ODOMETRY = "nav_msgs/msg/Odometry"


def drives(peer: Ros2Peer, forward: float, left: float) -> bool:
    """Publish a velocity at 10 Hz, as teleop_twist_keyboard repeats it; return whether /odom comes to have it."""
    peer.received("/odom", ODOMETRY)
    end = time.monotonic() + 2 * DEADLINE
    while time.monotonic() < end:
        peer.publish("/cmd_vel", "geometry_msgs/msg/Twist", {"linear": {"x": forward}, "angular": {"z": left}})
        time.sleep(0.1)
        for odometry in peer.received("/odom")[-1:]:
            velocity = odometry["twist"]["twist"]
            if (velocity["linear"]["x"], velocity["angular"]["z"]) == pytest.approx((forward, left), rel=0.05):
                return True
    return False


def test_the_ball_publishes_its_time(ros2_domain: Domain, ros2_peer: Ros2Peer, tmp_path: Path) -> None:
    with Node(ros2_domain.env(), tmp_path / "log", "ball", "--ros=2"):
        ros2_peer.next("/simulationTime", "std_msgs/msg/Float32", count=6, depth=100)
        first, *others = (message["data"] for message in ros2_peer.received("/simulationTime")[:6])
        assert others == pytest.approx([first + 0.05 * count for count in range(1, 6)], abs=1e-4)
        assert ros2_peer.graph()["topics"]["/tf"]["types"] == ["tf2_msgs/msg/TFMessage"]


def test_the_tricycle_of_the_tutorial_drives_by_ros2(ros2_domain: Domain, ros2_peer: Ros2Peer, tmp_path: Path) -> None:
    with Node(ros2_domain.env(), tmp_path / "log", "tricycle", "--ros=2", "--speed=2"):
        start = ros2_peer.next("/odom", "nav_msgs/msg/Odometry")["pose"]["pose"]["position"]["x"]
        ros2_peer.publish("/speed", "std_msgs/msg/Float32", {"data": 5.0})

        def has_moved(message: dict[str, Any]) -> bool:
            return abs(message["pose"]["pose"]["position"]["x"] - start) > 0.5

        ros2_peer.wait_for("/odom", "nav_msgs/msg/Odometry", has_moved, "the tricycle to move")
        assert ros2_peer.next("/front_sonar", "std_msgs/msg/Float32").keys() == {"data"}
        info = ros2_peer.next("/camera_info", "sensor_msgs/msg/CameraInfo")
        assert (len(info["k"]), info["distortion_model"]) == (9, "plumb_bob")


def test_the_tricycle_follows_a_teleop_node(ros2_domain: Domain, ros2_peer: Ros2Peer, tmp_path: Path) -> None:
    with Node(ros2_domain.env(), tmp_path / "log", "tricycle_cmd_vel", "--ros=2"):
        assert drives(ros2_peer, 0.5, 0.25)


def test_the_pioneer_drives_and_publishes_its_points_and_the_clock(
    ros2_domain: Domain, ros2_peer: Ros2Peer, tmp_path: Path
) -> None:
    with Node(ros2_domain.env(), tmp_path / "log", "pioneer", "--ros=2"):
        assert drives(ros2_peer, 0.3, 0.2)
        cloud = ros2_peer.next("/lidarPC", "sensor_msgs/msg/PointCloud2")
        assert [field["name"] for field in cloud["fields"]][:3] == ["x", "y", "z"]
        assert len(cloud["data"]) == cloud["width"] * cloud["point_step"] > 0
        assert ros2_peer.graph()["topics"]["/tf"]["types"] == ["tf2_msgs/msg/TFMessage"]
        clock = ros2_peer.next("/clock", "rosgraph_msgs/msg/Clock", best_effort=True)["clock"]
        assert clock["sec"] < 1_000_000
