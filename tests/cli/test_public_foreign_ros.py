# SPDX-License-Identifier: BSD-3-Clause
"""A public Pioneer of CoppeliaSim whose own scripts drive it by topics of ROS, and publish odometry and lidar."""

import math
from pathlib import Path

import pytest

from node_support import Node
from public_foreign_files import each_of, find, needs_files
from ros_peer import Messages, Peer
from ros_support import RosCore

pytestmark = needs_files

WHEEL_RADIUS = 0.0975  # m
SPEED = 3.0  # rad/s


@pytest.mark.parametrize("file", each_of(find("ros_pioneer.ttt")))
def test_a_pioneer_drives_by_topics_and_measures(roscore: RosCore, tmp_path: Path, file: Path) -> None:
    with Peer(roscore, tmp_path / "peer") as peer, Node(roscore.env, tmp_path / "log", file, "--speed", "2") as node:
        for side in ("left", "right"):
            peer.publish(f"/pioneer/{side}_wheel_velocity", "std_msgs/Float32", {"data": SPEED})
        odometry = Messages(peer, "/coppelia_odom", "nav_msgs/Odometry")
        place = Messages(peer, "/gt_relative_pose", "geometry_msgs/Pose")
        odometry.next(
            lambda message: math.isclose(message["twist"]["twist"]["linear"]["x"], SPEED * WHEEL_RADIUS), "speed"
        )
        start = place.next(lambda _: True, "a place")["position"]

        def is_half_a_metre_ahead(pose: dict[str, dict[str, float]]) -> bool:
            return math.hypot(pose["position"]["x"] - start["x"], pose["position"]["y"] - start["y"]) > 0.5

        place.next(is_half_a_metre_ahead, "half a metre")
        points = peer.next("/points1", "sensor_msgs/PointCloud")["points"]
        assert len(points) > 20
        ranges = sorted(math.hypot(point["x"], point["y"]) for point in points)
        assert ranges[0] > 0.1  # it looks out of its body
        assert ranges[-1] < 5
        assert "error:" not in node.output
