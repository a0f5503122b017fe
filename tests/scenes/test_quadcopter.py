# SPDX-License-Identifier: BSD-3-Clause
"""The quadcopter of the scene in a node, with and without ROS."""

import math
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

from bubblesim import _core
from node_support import Node, run_sim, write
from ros_peer import Message, Peer
from ros_support import RosCore

REPORT = """
def sysCall_init():
    self.body = sim.getObject('/Quadcopter/base_link')

def sysCall_sensing():
    if sim.getSimulationTime() > 9.98:
        print('AT', *sim.getObjectPosition(self.body))
"""


def place(odometry: Message) -> list[float]:
    found = odometry["pose"]["pose"]["position"]
    return [found["x"], found["y"], found["z"]]


def is_at(*wanted: float) -> Callable[[Message], bool]:
    return lambda odometry: math.dist(place(odometry), wanted) < 0.02


def test_it_hovers_without_ros(tmp_path: Path) -> None:
    script = write(tmp_path / "report.py", REPORT)
    run = run_sim(
        "quadcopter", "--no-ros", "--until", 10, "--speed", "max", "--strict", "--child-script", f"/Pad={script}"
    )
    assert run.returncode == 0, run.stderr
    position = [float(number) for number in run.stdout.split("AT")[1].split()[:3]]
    assert position == pytest.approx([0.0, 0.0, 1.0], abs=1e-3)


def test_it_follows_goals_and_velocities_and_stays_in_the_wind(roscore: RosCore, tmp_path: Path) -> None:
    odometry = "nav_msgs/Odometry"
    with (
        Node(roscore.env, tmp_path / "log", "quadcopter", "--speed", "4") as node,
        Peer(roscore, tmp_path / "received") as peer,
    ):
        node.wait_until_listed(roscore)
        peer.wait_for("/odom", odometry, is_at(0.0, 0.0, 1.0), "the take-off")
        goal: dict[str, Any] = {"pose": {"position": {"x": 1.0, "y": -0.5, "z": 1.5}, "orientation": {"w": 1.0}}}
        peer.publish("/goal", "geometry_msgs/PoseStamped", goal)
        peer.wait_for("/odom", odometry, is_at(1.0, -0.5, 1.5), "the goal")
        peer.publish("/world/quadcopter/wind", "geometry_msgs/Vector3", {"x": 0.0, "y": 4.0, "z": 0.0})
        leans = "the lean into the wind"
        peer.wait_for("/odom", odometry, lambda it: it["pose"]["pose"]["orientation"]["x"] > 0.02, leans)
        peer.wait_for("/odom", odometry, is_at(1.0, -0.5, 1.5), "the goal in the wind")
        peer.publish("/cmd_vel", "geometry_msgs/Twist", {"linear": {"z": 0.5}, "angular": {}})
        peer.wait_for("/odom", odometry, lambda it: place(it)[2] > 1.6, "the climb")
        fix = peer.next("/gps/fix", "sensor_msgs/NavSatFix")
        assert fix["altitude"] > 409.0


def test_actuator_messages_command_the_propellers(roscore: RosCore, tmp_path: Path) -> None:
    robot = """<sdf version="1.9"><world name="w"><gravity>0 0 0</gravity><model name="Twin">
      <link name="frame"/><link name="blades"/>
      <joint name="spindle" type="revolute"><parent>frame</parent><child>blades</child>
      <axis><xyz>0 0 1</xyz></axis></joint>
      <plugin name="motor" filename="librotors_gazebo_motor_model.so"><jointName>spindle</jointName>
        <turningDirection>ccw</turningDirection><motorNumber>1</motorNumber>
        <motorSpeedPubTopic>motor_speed/1</motorSpeedPubTopic></plugin></model></world></sdf>"""
    with (
        Node(roscore.env, tmp_path / "log", write(tmp_path / "twin.sdf", robot)) as node,
        Peer(roscore, tmp_path / "received") as peer,
    ):
        node.wait_until_listed(roscore)
        topic = "/Twin/command/motor_speed"
        peer.publish(topic, "mav_msgs/Actuators", {"angular_velocities": [100.0, 400.0]})
        reached = peer.wait_for(
            "/Twin/motor_speed/1", "std_msgs/Float32", lambda it: it["data"] > 39.9, "the speed of the joint"
        )
        assert reached["data"] == pytest.approx(40.0, abs=0.1)
        peer.publish(topic, "mav_msgs/Actuators", {"angular_velocities": [100.0]})
        node.wait_for_output("1 angular_velocities ignored: motorNumber is 1")


def test_actuators_have_the_md5_of_the_original() -> None:
    # From rosserial's code for mav_msgs.
    assert _core.messages.type_hash("mav_msgs/Actuators") == "25741daf38ed25442e3a66a855ee8d9c"
