# SPDX-License-Identifier: BSD-3-Clause
"""A bag has the messages of Gazebo plugins, which do not go through Python."""

from pathlib import Path

import pytest
import rosbag

from node_support import Node
from ros_peer import Peer
from ros_support import REPOSITORY, RosCore

ROVER = (REPOSITORY / "scenes/models/rover/rover.urdf").read_text()
WORLD = REPOSITORY / "tests/gazebo_plugins/walls.sdf"


def test_a_bag_has_what_plugins_publish_and_receive(roscore: RosCore, tmp_path: Path) -> None:
    bag = tmp_path / "run.bag"
    options = "--gazebo-compat", "--record", bag
    with Node(roscore.env, tmp_path / "log", WORLD, *options), Peer(roscore, tmp_path / "received") as peer:
        rover = {"model_name": "rover", "model_xml": ROVER, "robot_namespace": "/"}
        assert peer.call("/gazebo/spawn_urdf_model", **rover)["success"]
        peer.drive("/cmd_vel", 0.5, 0.0)
        truth = "/truth", "nav_msgs/Odometry"
        peer.wait_for(*truth, lambda odometry: odometry["pose"]["pose"]["position"]["x"] > 0.1, "motion")
    with rosbag.Bag(str(bag)) as file:
        recorded = [(topic, type(message)._type, message) for topic, message, _ in file.read_messages()]
    twists = [message for topic, _, message in recorded if topic == "/cmd_vel"]
    assert twists
    assert {twist.linear.x for twist in twists} == {0.5}
    scans = [message for topic, _, message in recorded if topic == "/scan"]  # without a subscriber
    assert len({scan.header.stamp.to_sec() for scan in scans}) == len(scans) > 1
    assert all(len(scan.ranges) == len(scans[0].ranges) > 1 for scan in scans)
    forward = [message.pose.pose.position.x for topic, _, message in recorded if topic == "/odom"]
    assert forward[0] == pytest.approx(0.0, abs=0.01)
    assert forward[-1] > 0.1
