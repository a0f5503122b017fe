# SPDX-License-Identifier: BSD-3-Clause
"""Plugins that command single joints, in one world."""

from collections.abc import Callable
from typing import Any

import pytest

from node_support import write
from plugin_models import joint, link, plugin, world
from ros_peer import Message, Messages, Peer

ARM = (
    link("base", 0, 0, 0.5, 50, 1)
    + link("arm", 0, 0, 1, 1, 0.1)
    + '<joint name="foot" type="fixed"><parent>world</parent><child>base</child></joint>'
    + joint("arm_joint", "base", "arm", "0 0 1")
    + plugin("libgazebo_ros_joint_pose_trajectory.so", robotNamespace="/")
    + plugin("libgazebo_ros_joint_state_publisher.so", robotNamespace="/", jointName="arm_joint")
)
GZ_ARM = (
    link("base", 0, 0, 0.5, 50, 1)
    + link("arm", 0, 0, 1, 1, 0.1)
    + link("disc", 0, 0, 1.5, 1, 0.1)
    + '<joint name="foot" type="fixed"><parent>world</parent><child>base</child></joint>'
    + joint("gz_arm_joint", "base", "arm", "0 0 1")
    + joint("gz_disc_joint", "arm", "disc", "0 0 1")
    + link("flywheel", 0, 0, 2, 1, 0.1)
    + joint("gz_flywheel_joint", "disc", "flywheel", "0 0 1").replace(
        "</axis>", "<dynamics><damping>0.2</damping></dynamics></axis>"
    )
    + plugin("gz-sim-apply-joint-force-system", joint_name="gz_flywheel_joint")
    + plugin("gz-sim-joint-position-controller-system", joint_name="gz_arm_joint", initial_position="0.2")
    + plugin("gz-sim-joint-controller-system", joint_name="gz_disc_joint", topic="gz_disc")
    + plugin("gz-sim-joint-state-publisher-system", topic="gz_arm/joints")
)
WORLD = world(
    f'<model name="gz_arm"><pose>0 90 0 0 0 0</pose>{GZ_ARM}</model>',
    f'<model name="robot_arm"><pose>0 60 0 0 0 0</pose>{ARM}</model>',
)


@pytest.fixture(scope="module")
def running(run: Callable[..., Any], tmp_path_factory: pytest.TempPathFactory) -> Any:
    file = write(tmp_path_factory.mktemp("joints") / "joints.sdf", WORLD)
    return run(file, "--speed", "4", "--gazebo-compat")


def test_gz_sims_joints_follow_their_commands(peer: Peer) -> None:
    def arm(position: float, speed: float) -> None:
        def there(state: Message) -> bool:
            axes = {name: i for i, name in enumerate(state["name"])}
            return state["position"][axes["gz_arm_joint"]] == pytest.approx(position, abs=0.01) and state["velocity"][
                axes["gz_disc_joint"]
            ] == pytest.approx(speed, abs=0.01)

        peer.wait_for("/gz_arm/joints", "sensor_msgs/JointState", there, f"the joints to follow {position}, {speed}")

    arm(0.2, 0.0)
    peer.publish("/model/gz_arm/joint/gz_arm_joint/0/cmd_pos", "std_msgs/Float64", {"data": -0.5})
    peer.publish("/gz_disc", "std_msgs/Float64", {"data": 1.5})
    arm(-0.5, 1.5)


def test_gz_sims_force_accelerates_a_joint_to_where_its_damping_holds(peer: Peer) -> None:
    peer.publish("/model/gz_arm/joint/gz_flywheel_joint/cmd_force", "std_msgs/Float64", {"data": 0.3})

    def holds(state: Message) -> bool:
        index = state["name"].index("gz_flywheel_joint")
        found = state["velocity"][index], state["effort"][index]
        return bool(found == pytest.approx((0.3 / 0.2, 0.3), abs=0.01))

    peer.wait_for("/gz_arm/joints", "sensor_msgs/JointState", holds, "the flywheel to turn at 1.5 rad/s by 0.3 N m")


def test_joints_go_through_a_trajectory(running: Any, peer: Peer) -> None:
    points = [
        {"positions": [0.5], "time_from_start": {"secs": 0}},
        {"positions": [-0.3], "time_from_start": {"secs": 2}},
    ]
    command = {"joint_names": ["arm_joint"], "points": points}
    peer.next("/joint_states", "sensor_msgs/JointState")  # it stands at the first angle for half a second only
    states = Messages(peer, "/joint_states", "sensor_msgs/JointState")
    peer.publish("/set_joint_trajectory", "trajectory_msgs/JointTrajectory", command)

    def at(angle: float) -> Message:
        return states.next(
            lambda state: bool(state["position"] == pytest.approx([angle], abs=0.01)),
            f"the joint to stand at {angle} rad",
        )

    first = at(0.5)
    assert at(-0.3)["header"]["stamp"] > first["header"]["stamp"]
    peer.publish("/set_joint_trajectory", "trajectory_msgs/JointTrajectory", {"joint_names": ["leg"], "points": points})
    running.node.wait_for_output("cannot process a message on /set_joint_trajectory")
    assert peer.next("/joint_states")["position"] == pytest.approx([-0.3], abs=0.01), "the rest goes on"
