# SPDX-License-Identifier: BSD-3-Clause
"""Contact and force sensors of robots: a box on the floor, and a weight that hangs from a joint."""

from collections.abc import Callable
from typing import Any

import pytest

from node_support import write
from ros_peer import Message, Peer

WORLD = """\
<sdf version="1.9" xmlns:bubblesim="https://bubblesim">
  <world name="touch">
    <model name="floor"><static>true</static><link name="link">
      <collision name="top"><geometry><plane><normal>0 0 1</normal></plane></geometry></collision></link></model>
    <model name="box">
      <pose>0 0 0.1 0 0 0</pose>
      <link name="body">
        <inertial><mass>2</mass><inertia><ixx>0.02</ixx><iyy>0.02</iyy><izz>0.02</izz></inertia></inertial>
        <collision name="shell"><geometry><box><size>0.2 0.2 0.2</size></box></geometry></collision>
        <sensor name="bumper" type="contact">
          <update_rate>20</update_rate>
          <contact><collision>shell</collision></contact>
          <bubblesim:topic>own/bumper</bubblesim:topic>
          <plugin name="bumper" filename="libgazebo_ros_bumper.so">
            <bumperTopicName>bumper</bumperTopicName><frameName>body</frameName>
          </plugin>
        </sensor>
      </link>
    </model>
    <model name="crane">
      <pose>5 0 1 0 0 0</pose>
      <link name="arm"><inertial><mass>1</mass></inertial></link>
      <link name="weight"><inertial><mass>3</mass></inertial></link>
      <joint name="mount" type="fixed"><parent>world</parent><child>arm</child></joint>
      <joint name="rope" type="fixed"><parent>arm</parent><child>weight</child>
        <sensor name="force" type="force_torque"><update_rate>20</update_rate></sensor></joint>
      <plugin name="force" filename="libgazebo_ros_ft_sensor.so">
        <jointName>rope</jointName><topicName>rope_force</topicName>
      </plugin>
    </model>
  </world>
</sdf>
"""
GRAVITY = 9.8  # m/s^2, SDFormat's default


@pytest.fixture(scope="module")
def peer(run: Callable[..., Any], tmp_path_factory: pytest.TempPathFactory) -> Peer:
    peer: Peer = run(write(tmp_path_factory.mktemp("touch") / "touch.sdf", WORLD), "--speed", "2").peer
    return peer


def vector(message: Message) -> list[float]:
    return [message[axis] for axis in "xyz"]


def test_a_bumper_reports_what_touches_it_in_its_frame(peer: Peer) -> None:
    message = peer.next("/bumper", "gazebo_msgs/ContactsState", count=10)
    assert message["header"]["frame_id"] == "body"
    (state,) = message["states"]
    assert (state["collision1_name"], state["collision2_name"]) == ("box::body::shell", "floor::link::top")
    assert vector(state["total_wrench"]["force"]) == pytest.approx([0, 0, 2 * GRAVITY], abs=0.5)
    assert len(state["wrenches"]) == len(state["depths"]) == len(state["contact_positions"])
    for position, normal in zip(state["contact_positions"], state["contact_normals"], strict=True):
        assert [abs(at) for at in vector(position)] == pytest.approx([0.1, 0.1, 0.1], abs=2e-3)
        assert vector(normal) == pytest.approx([0, 0, 1], abs=1e-6)


def test_a_contact_sensor_publishes_itself_in_world_axes(peer: Peer) -> None:
    message = peer.next("/own/bumper", "gazebo_msgs/ContactsState", count=10)
    (state,) = message["states"]
    assert state["collision2_name"] == "floor::link::top"
    assert vector(state["contact_normals"][0]) == pytest.approx([0, 0, 1], abs=1e-6)
    assert vector(state["contact_positions"][0])[2] == pytest.approx(0, abs=2e-3)


def test_a_joint_returns_its_child(peer: Peer) -> None:
    message = peer.next("/rope_force", "geometry_msgs/WrenchStamped", count=5)
    assert message["header"]["frame_id"] == "weight"
    assert [abs(value) for value in vector(message["wrench"]["force"])] == pytest.approx([0, 0, 3 * GRAVITY], abs=0.2)
