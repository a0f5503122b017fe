# SPDX-License-Identifier: BSD-3-Clause
"""Drives with wheels of other kinds than the rover's, in one world."""

import math
import os
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

from node_support import write
from plugin_models import RADIUS, TRACK, WHEELBASE, link, moving, plugin, robot, steered, velocity, wheel, world
from ros_peer import Message, Peer
from ros_support import wait_until

REAR = wheel("left", 0, TRACK / 2) + wheel("right", 0, -TRACK / 2)
FOUR = REAR + wheel("front_left", WHEELBASE, TRACK / 2) + wheel("front_right", WHEELBASE, -TRACK / 2)
SKID = plugin(
    "libgazebo_ros_skid_steer_drive.so",
    robotNamespace="skid",
    leftFrontJoint="front_left_joint",
    rightFrontJoint="front_right_joint",
    leftRearJoint="left_joint",
    rightRearJoint="right_joint",
    wheelSeparation=str(TRACK),
    wheelDiameter=str(2 * RADIUS),
    torque="20",
    robotBaseFrame="body",
    broadcastTF="1",
)
TRICYCLE = plugin(
    "libgazebo_ros_tricycle_drive.so",
    steeringJoint="front_steering",
    actuatedWheelJoint="front_joint",
    encoderWheelLeftJoint="left_joint",
    encoderWheelRightJoint="right_joint",
    actuatedWheelDiameter=str(2 * RADIUS),
    encoderWheelDiameter=str(2 * RADIUS),
    encoderWheelSeparation=str(TRACK),
    wheelTorque="20",
    odometrySource="encoder",
    publishWheelJointState="true",
)
ACKERMANN = plugin(
    "libgazebo_ros_ackermann_drive.so",
    front_left_joint="car_left_joint",
    front_right_joint="car_right_joint",
    rear_left_joint="left_joint",
    rear_right_joint="right_joint",
    left_steering_joint="car_left_steering",
    right_steering_joint="car_right_steering",
    publish_odom="true",
).replace("<front_left", "<ros><namespace>/car</namespace></ros><front_left")
GZ = plugin(
    "ignition-gazebo-diff-drive-system",
    wheel_separation=str(TRACK),
    wheel_radius=str(RADIUS),
    max_linear_velocity="0.4",
    left_joint="left_joint",
    right_joint="right_joint",
) + plugin("gz-sim-joint-state-publisher-system", topic="gz/joints", joint_name="left_joint")
GZ_CAR = plugin(
    "gz-sim-ackermann-steering-system",
    left_joint="left_joint",
    right_joint="right_joint",
    left_steering_joint="gz_left_steering",
    right_steering_joint="gz_right_steering",
    wheel_base=str(WHEELBASE),
    wheel_separation=str(TRACK),
    kingpin_width=str(TRACK),
    wheel_radius=str(RADIUS),
)
GAZEBO = plugin("libDiffDrivePlugin.so", left_joint="left_joint", right_joint="right_joint", torque="20")
CASTER = (
    link("ball", WHEELBASE, 0, 0.05, 0.2, 0.0002, "<sphere><radius>0.05</radius></sphere>").replace(
        "</geometry>", "</geometry><surface><friction><ode><mu>0</mu><mu2>0</mu2></ode></friction></surface>"
    )
    + '<joint name="ball_joint" type="fixed"><parent>body</parent><child>ball</child></joint>'
)

ROS2 = plugin(
    "libgazebo_ros_diff_drive.so",
    left_joint="left_joint",
    right_joint="right_joint",
    wheel_separation=str(TRACK),
    wheel_diameter=str(2 * RADIUS),
    max_wheel_torque="20",
    publish_odom="true",
)
SMALL = wheel("small_left", WHEELBASE, TRACK / 4, radius=RADIUS / 2) + wheel(
    "small_right", WHEELBASE, -TRACK / 4, radius=RADIUS / 2
)
PAIRS = (
    '<plugin name="drive" filename="libgazebo_ros_diff_drive.so"><num_wheel_pairs>2</num_wheel_pairs>'
    "<left_joint>left_joint</left_joint><left_joint>small_left_joint</left_joint>"
    "<right_joint>right_joint</right_joint><right_joint>small_right_joint</right_joint>"
    f"<wheel_separation>{TRACK}</wheel_separation><wheel_separation>{TRACK / 2}</wheel_separation>"
    f"<wheel_diameter>{2 * RADIUS}</wheel_diameter><wheel_diameter>{RADIUS}</wheel_diameter>"
    "<max_wheel_torque>20</max_wheel_torque><publish_odom>true</publish_odom></plugin>"
) + plugin("libgazebo_ros_joint_state_publisher.so")
MISCOUNTED = PAIRS.replace(">2</num", ">3</num").replace('"drive"', '"miscounted"')
WORLD = world(
    robot("skid", 0, FOUR, SKID),
    robot("tricycle", 10, REAR + steered("front", WHEELBASE, 0), TRICYCLE),
    robot(
        "car",
        20,
        REAR + steered("car_left", WHEELBASE, TRACK / 2) + steered("car_right", WHEELBASE, -TRACK / 2),
        ACKERMANN,
    ),
    robot("gz", 30, REAR + CASTER, GZ),
    robot(
        "gz_car",
        70,
        REAR + steered("gz_left", WHEELBASE, TRACK / 2) + steered("gz_right", WHEELBASE, -TRACK / 2),
        GZ_CAR,
    ),
    robot("plain", 40, REAR + CASTER, GAZEBO),
    robot("ros2", 80, REAR + CASTER, ROS2),
    robot("pairs", 100, REAR + SMALL, PAIRS),
    robot("miscounted", 110, REAR + SMALL, MISCOUNTED),
)


@pytest.fixture(scope="module")
def running(run: Callable[..., Any], tmp_path_factory: pytest.TempPathFactory) -> Any:
    file = write(tmp_path_factory.mktemp("drives") / "drives.sdf", WORLD)
    return run(file, "--speed", "4", "--gazebo-compat")


def test_a_skid_steer_drive_drives_and_turns(peer: Peer) -> None:
    peer.drive("/skid/cmd_vel", 0.5, 0.0)
    odom = moving(peer, "/skid/odom", "x", 0.45)
    assert velocity(odom) == pytest.approx((0.5, 0.0), abs=0.02)
    assert (odom["header"]["frame_id"], odom["child_frame_id"]) == ("odom", "body")
    peer.drive("/skid/cmd_vel", 0.0, 1.0)
    assert velocity(moving(peer, "/skid/odom", "yaw", 0.1))[1] > 0, "to the left; slower than asked, for it skids"


def test_a_tricycle_turns_about_where_its_axles_meet(peer: Peer) -> None:
    peer.drive("/tricycle/cmd_vel", 0.5, 0.5)
    odom = moving(peer, "/tricycle/odom", "yaw", 0.4)
    # The front wheel rolls at 0.5 m/s, 0.5 rad to the left: v = 0.5 cos(0.5), w = 0.5 sin(0.5) / wheelbase.
    assert velocity(odom) == pytest.approx((0.5 * math.cos(0.5), 0.5 * math.sin(0.5) / WHEELBASE), rel=0.03)
    assert odom["header"]["frame_id"] == "tricycle/odom"
    states = peer.next("/tricycle/joint_states", "sensor_msgs/JointState")
    assert states["position"][states["name"].index("front_steering")] == pytest.approx(0.5, abs=0.01)
    efforts = [abs(effort) for effort in states["effort"]]
    assert max(efforts) < 5, "what the motors exert while it rolls, not their limit of 20 N m"
    assert len(efforts) == 4
    assert sum(efforts) > 0


def test_a_car_turns_about_where_its_axles_meet(peer: Peer) -> None:
    peer.drive("/car/cmd_vel", 0.5, 0.3)
    odom = moving(peer, "/car/odom", "yaw", 0.2)
    forward, turning = velocity(odom)
    # The rear wheels run at 0.5 m/s: w = v tan(0.3) / wheelbase.
    assert forward == pytest.approx(0.5, rel=0.05)
    assert turning == pytest.approx(forward * math.tan(0.3) / WHEELBASE, rel=0.05)


def test_gz_sims_drive_keeps_to_its_limits(peer: Peer) -> None:
    peer.drive("/model/gz/cmd_vel", 1.0, 0.0)
    odom = moving(peer, "/model/gz/odometry", "x", 0.35)
    assert velocity(odom) == pytest.approx((0.4, 0.0), abs=0.01)
    assert (odom["header"]["frame_id"], odom["child_frame_id"]) == ("gz/odom", "gz/base_link")
    assert peer.next("/gz/joints", "sensor_msgs/JointState")["velocity"] == pytest.approx([0.4 / RADIUS], rel=0.02)


def test_gz_sims_car_turns_at_the_commanded_rate(peer: Peer) -> None:
    peer.drive("/model/gz_car/cmd_vel", 0.5, 0.3)
    odom = moving(peer, "/model/gz_car/odometry", "yaw", 0.2)
    assert velocity(odom) == pytest.approx((0.5, 0.3), rel=0.07)
    assert (odom["header"]["frame_id"], odom["child_frame_id"]) == ("gz_car/odom", "gz_car/base_link")


def test_ros_2s_drive_turns_to_the_left_for_a_positive_rate(peer: Peer) -> None:
    peer.drive("/ros2/cmd_vel", 0.3, 0.5)
    assert velocity(moving(peer, "/ros2/odom", "yaw", 0.4)) == pytest.approx((0.3, 0.5), abs=0.05)


def test_ros_2s_drive_drives_each_pair_of_wheels_by_its_own_measures(running: Any, peer: Peer) -> None:
    peer.drive("/pairs/cmd_vel", 0.3, 0.0)
    assert velocity(moving(peer, "/pairs/odom", "x", 0.28)) == pytest.approx((0.3, 0.0), abs=0.01)

    def speeds(forward: float, turning: float) -> Message:
        rims = {side: forward + sign * turning * TRACK / 2 for side, sign in (("left", -1), ("right", 1))}
        small = {side: forward + sign * turning * TRACK / 4 for side, sign in (("left", -1), ("right", 1))}
        return {f"{side}_joint": rims[side] / RADIUS for side in rims} | {
            f"small_{side}_joint": small[side] / (RADIUS / 2) for side in small
        }

    def turn_at(wanted: Message) -> None:
        def holds(state: Message) -> bool:
            found = dict(zip(state["name"], state["velocity"], strict=True))
            return found == pytest.approx(wanted, abs=0.05)

        peer.wait_for("/pairs/joint_states", "sensor_msgs/JointState", holds, f"wheels to turn at {wanted}")

    turn_at(speeds(0.3, 0.0))
    peer.drive("/pairs/cmd_vel", 0.0, 0.5)
    turn_at(speeds(0.0, 0.5))
    running.node.wait_for_output("<leftJoint> is given 2 times, expected 3")


def test_gazebos_own_drive_takes_its_measures_from_the_model(peer: Peer) -> None:
    peer.drive("/plain/cmd_vel", 0.5, 0.5)
    peer.received("/gazebo/model_states", "gazebo_msgs/ModelStates")

    def twist() -> tuple[float, float]:
        states = peer.next("/gazebo/model_states")
        found = states["twist"][states["name"].index("plain")]
        return math.hypot(found["linear"]["x"], found["linear"]["y"]), found["angular"]["z"]

    wait_until(lambda: twist() == pytest.approx((0.5, 0.5), rel=0.05), "the speeds of the Twist")


@pytest.mark.skipif(not os.environ.get("BUBBLESIM_ZOO"), reason="BUBBLESIM_ZOO names no folder of Gazebo's models")
@pytest.mark.parametrize("model", ["pioneer2dx", "pioneer3at"])
def test_gazebos_pioneers_drive(peer: Peer, model: str) -> None:
    text = (Path(os.environ["BUBBLESIM_ZOO"]) / model / "model.sdf").read_text()
    response = peer.call(
        "/gazebo/spawn_sdf_model",
        model_name=model,
        model_xml=text,
        initial_pose={"position": {"y": -10.0, "z": 0.01}, "orientation": {"w": 1.0}},
    )
    assert response["success"], response["status_message"]
    peer.drive(f"/{model}/cmd_vel", 0.3, 0.0)
    peer.received("/gazebo/model_states", "gazebo_msgs/ModelStates")

    def ahead() -> float:
        states = peer.next("/gazebo/model_states")
        x: float = states["pose"][states["name"].index(model)]["position"]["x"]
        return x

    wait_until(lambda: ahead() > 0.5, "half a metre of driving")
    assert peer.call("/gazebo/delete_model", model_name=model)["success"]
