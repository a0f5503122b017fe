# SPDX-License-Identifier: BSD-3-Clause
"""A node that uses ROS 1 and ROS 2: scripts by their module, what is the node's own on both."""

from collections.abc import Iterator
from pathlib import Path

import pytest

from node_support import Node, write
from ros2_peer import Domain, Ros2Peer
from ros_peer import Peer
from ros_support import RosCore, start, stop_launch, wait_until

SCRIPT = """
    def sysCall_init():
        self.one = simROS.advertise('/one', 'std_msgs/Float32')
        self.two = simROS2.createPublisher('/two', 'std_msgs/Float32')
        simROS.subscribe('/to_one', 'std_msgs/Float32', 'on_one')
        simROS2.createSubscription('/to_two', 'std_msgs/Float32', 'on_two')
        print('versions', simROS.rosVersion(), simROS2.rosVersion(), flush=True)

    def on_one(message):
        print('one', message['data'], flush=True)

    def on_two(message):
        print('two', message['data'], flush=True)

    def sysCall_sensing():
        simROS.publish(self.one, {'data': 1.0})
        simROS2.publish(self.two, {'data': 2.0})
"""


@pytest.fixture
def peers(roscore: RosCore, ros2_peer: Ros2Peer, tmp_path: Path) -> Iterator[tuple[Peer, Ros2Peer]]:
    with Peer(roscore, tmp_path / "ros1_peer.log") as peer:
        yield peer, ros2_peer


def env(core: RosCore, domain: Domain) -> dict[str, str]:
    return core.env | {"ROS_DOMAIN_ID": str(domain.number)}


def test_each_module_of_a_script_has_its_side(
    roscore: RosCore, ros2_domain: Domain, peers: tuple[Peer, Ros2Peer], tmp_path: Path
) -> None:
    ros1, ros2 = peers
    file = write(tmp_path / "script.py", SCRIPT)
    options = ["--ros=both", "--child-script", f"/Ball={file}"]
    with Node(env(roscore, ros2_domain), tmp_path / "log", "ball", *options) as node:
        node.wait_for_output("versions 1 2")
        assert ros1.next("/one", "std_msgs/Float32") == {"data": 1.0}
        assert ros2.next("/two", "std_msgs/msg/Float32") == {"data": 2.0}
        ros1.publish("/to_one", "std_msgs/Float32", {"data": 3.5})
        ros2.publish("/to_two", "std_msgs/msg/Float32", {"data": 4.5})
        node.wait_for_output("one 3.5")
        node.wait_for_output("two 4.5")
        topics = ros2.graph()["topics"]
        assert not {"/one", "/to_one"} & topics.keys()
        assert "/two" not in roscore.state()["publishers"]


def test_drives_and_services_of_the_node_are_on_both(
    roscore: RosCore, ros2_domain: Domain, peers: tuple[Peer, Ros2Peer], tmp_path: Path
) -> None:
    ros1, ros2 = peers
    world = write(tmp_path / "robot.sdf", ROBOT)
    with Node(env(roscore, ros2_domain), tmp_path / "log", world, "--ros=both"):
        start = ros1.next("/odom", "nav_msgs/Odometry")["pose"]["pose"]["position"]["x"]
        ros2.publish("/cmd_vel", "geometry_msgs/msg/Twist", {"linear": {"x": 0.5}})
        ros1.wait_for(
            "/odom", "nav_msgs/Odometry", lambda m: m["pose"]["pose"]["position"]["x"] > start + 0.1, "motion by ROS 2"
        )
        ros1.drive("/cmd_vel", 0.0, 0.0)
        ros2.wait_for(
            "/odom",
            "nav_msgs/msg/Odometry",
            lambda m: abs(m["twist"]["twist"]["linear"]["x"]) < 0.01,
            "a stop by ROS 1",
        )
        assert ros2.next("/clock", "rosgraph_msgs/msg/Clock").keys() == {"clock"}
        assert "/sim_ros_interface/get_object_state" in roscore.state()["services"]
        assert "/sim_ros2_interface/get_object_state" in ros2.graph()["services"]
        ros2.call("/sim_ros2_interface/pause", "std_srvs/srv/Empty")
        paused = ros1.next("/simulationState", "std_msgs/Int32")
        assert paused == ros2.next("/simulationState", "std_msgs/msg/Int32")


def test_both_wait_for_their_own_peers(ros2_domain: Domain, ros2_peer: Ros2Peer, tmp_path: Path) -> None:
    """Without a master, the ROS 2 side works."""
    nowhere = ros2_domain.env(ROS_MASTER_URI="http://localhost:1", ROS_HOSTNAME="localhost")
    with Node(nowhere, tmp_path / "log", "tricycle", "--ros=both"):
        wait_until(lambda: "/sim_ros2_interface" in ros2_peer.graph()["nodes"], "the node")
        assert ros2_peer.next("/clock", "rosgraph_msgs/msg/Clock").keys() == {"clock"}


def test_a_launch_file_starts_both_on_simulated_time(
    roscore: RosCore, ros2_domain: Domain, ros2_peer: Ros2Peer, tmp_path: Path
) -> None:
    command = ["roslaunch", "bubblesim", "tricycle.launch", "controller:=false", "ros:=both"]
    with (tmp_path / "log").open("w") as log:
        launch = start(command, env(roscore, ros2_domain), stdout=log, stderr=log)
        try:
            assert ros2_peer.next("/clock", "rosgraph_msgs/msg/Clock").keys() == {"clock"}
            service, kind = "/sim_ros2_interface/get_parameters", "rcl_interfaces/srv/GetParameters"
            (on_simulated_time,) = ros2_peer.call(service, kind, names=["use_sim_time"])["values"]
            assert on_simulated_time["bool_value"] is True
            assert "/sim_ros2_interface" in ros2_peer.graph()["nodes"]
            assert "/sim_ros_interface" in roscore.nodes()
        finally:
            stop_launch(launch)


ROBOT = """\
<?xml version="1.0"?>
<sdf version="1.9">
  <world name="room">
    <physics name="default" type="ode"><max_step_size>0.005</max_step_size></physics>
    <model name="Floor">
      <static>true</static>
      <link name="link">
        <collision name="c"><geometry><plane><normal>0 0 1</normal></plane></geometry></collision>
      </link>
    </model>
    <model name="Robot">
      <pose>0 0 0.1 0 0 0</pose>
      <link name="base">
        <inertial><mass>1</mass><inertia><ixx>1</ixx><iyy>1</iyy><izz>1</izz></inertia></inertial>
        <collision name="c"><geometry><sphere><radius>0.1</radius></sphere></geometry></collision>
      </link>
      <plugin name="move" filename="libgazebo_ros_planar_move.so">
        <commandTopic>cmd_vel</commandTopic>
        <odometryTopic>odom</odometryTopic>
        <odometryFrame>odom</odometryFrame>
        <robotBaseFrame>base</robotBaseFrame>
        <odometryRate>20</odometryRate>
      </plugin>
    </model>
  </world>
</sdf>
"""
