# SPDX-License-Identifier: BSD-3-Clause
"""Drives of other kinds than the rover's, in one world."""

import math
import os
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

from node_support import write
from ros_peer import Message, Messages, Peer
from ros_support import wait_until

RADIUS, TRACK, WHEELBASE = 0.1, 0.4, 0.5  # m
INERTIA = "<inertia><ixx>{0}</ixx><iyy>{0}</iyy><izz>{0}</izz></inertia>"


def link(name: str, x: float, y: float, z: float, mass: float, inertia: float, shape: str = "") -> str:
    collision = f'<collision name="shape"><geometry>{shape}</geometry></collision>' if shape else ""
    inertial = f"<inertial><mass>{mass}</mass>{INERTIA.format(inertia)}</inertial>"
    return f'<link name="{name}"><pose>{x} {y} {z} 0 0 0</pose>{inertial}{collision}</link>'


def joint(name: str, parent: str, child: str, axis: str, limit: float = 1e16) -> str:
    limits = f"<limit><lower>{-limit}</lower><upper>{limit}</upper></limit>"
    ends = f"<parent>{parent}</parent><child>{child}</child>"
    return f'<joint name="{name}" type="revolute">{ends}<axis><xyz>{axis}</xyz>{limits}</axis></joint>'


def wheel(name: str, x: float, y: float, parent: str = "body", radius: float = RADIUS) -> str:
    sphere = f"<sphere><radius>{radius}</radius></sphere>"
    return link(name, x, y, radius, 1, 0.004, sphere) + joint(f"{name}_joint", parent, name, "0 1 0")


def steered(name: str, x: float, y: float) -> str:
    """Return a wheel below a part that turns about the vertical."""
    knuckle = link(f"{name}_knuckle", x, y, RADIUS, 0.5, 0.002) + joint(
        f"{name}_steering", "body", f"{name}_knuckle", "0 0 1", 0.7
    )
    return knuckle + wheel(name, x, y, f"{name}_knuckle")


def robot(name: str, y: float, parts: str, plugin: str) -> str:
    body = link("body", WHEELBASE / 2, 0, 0.2, 5, 0.2, "<box><size>0.6 0.3 0.1</size></box>")
    return f'<model name="{name}"><pose>0 {y} 0 0 0 0</pose>{body}{parts}{plugin}</model>'


def plugin(filename: str, **parameters: str) -> str:
    elements = "".join(f"<{name}>{value}</{name}>" for name, value in parameters.items())
    return f'<plugin name="drive" filename="{filename}">{elements}</plugin>'


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
PLANAR = plugin("libgazebo_ros_planar_move.so", robotNamespace="sledge", odometryFrame="odom", robotBaseFrame="body")
PUSHED = plugin(
    "libgazebo_ros_force_based_move.so", robotNamespace="pushed", robotBaseFrame="body", yaw_velocity_p_gain="10000"
)
BOX = link("body", 0, 0, 0, 5, 0.1, "<box><size>0.5 0.5 0.1</size></box>")

WORLD = "".join(
    [
        '<sdf version="1.9"><world name="drives"><model name="floor"><static>true</static><link name="link">',
        '<collision name="c"><geometry><plane><normal>0 0 1</normal></plane></geometry></collision></link></model>',
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
        f'<model name="gz_arm"><pose>0 90 0 0 0 0</pose>{GZ_ARM}</model>',
        f'<model name="robot_arm"><pose>0 60 0 0 0 0</pose>{ARM}</model>',
        f'<model name="sledge"><pose>0 50 0.05 0 0 0</pose>{BOX}{PLANAR}</model>',
        f'<model name="pushed"><pose>0 120 0.05 0 0 0</pose>{BOX}{PUSHED}</model>',
        "</world></sdf>",
    ]
)


@pytest.fixture(scope="module")
def running(run: Callable[..., Any], tmp_path_factory: pytest.TempPathFactory) -> Any:
    world = write(tmp_path_factory.mktemp("drives") / "drives.sdf", WORLD)
    return run(world, "--speed", "4", "--gazebo-compat")


@pytest.fixture
def peer(running: Any) -> Peer:
    peer: Peer = running.peer
    peer.call("/gazebo/reset_world")
    return peer


def moving(peer: Peer, topic: str, name: str, least: float) -> Message:
    """Return the odometry after a velocity has reached its value."""

    def fast(message: Message) -> bool:
        twist = message["twist"]["twist"]
        return abs(twist["linear"]["x"] if name == "x" else twist["angular"]["z"]) > least

    peer.wait_for(topic, "nav_msgs/Odometry", fast, f"{topic} to report motion")
    return peer.next(topic, count=5)


def velocity(message: Message) -> tuple[float, float]:
    twist = message["twist"]["twist"]
    return twist["linear"]["x"], twist["angular"]["z"]


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


def test_a_planar_move_goes_in_all_directions_against_friction(peer: Peer) -> None:
    peer.publish("/sledge/cmd_vel", "geometry_msgs/Twist", {"linear": {"x": 0.3, "y": 0.2}, "angular": {"z": 0.5}})
    twist = moving(peer, "/sledge/odom", "yaw", 0.45)["twist"]["twist"]
    # At the end of a step it has turned by half a step's angle more than the velocity command assumed.
    assert (twist["linear"]["x"], twist["linear"]["y"]) == pytest.approx((0.3, 0.2), abs=0.01)
    assert twist["angular"]["z"] == pytest.approx(0.5, abs=0.01)


def test_a_force_based_move_lags_behind_by_its_friction(peer: Peer) -> None:
    """A force of gain * error balances the friction of 5 kg: 49 N by 10,000 N s/m."""
    peer.publish("/pushed/cmd_vel", "geometry_msgs/Twist", {"linear": {"x": 0.3}})
    linear = moving(peer, "/pushed/odom", "x", 0.29)["twist"]["twist"]["linear"]
    assert linear["x"] == pytest.approx(0.3 - 5 * 9.81 / 10000, abs=2e-4)
    peer.publish("/pushed/cmd_vel", "geometry_msgs/Twist", {"linear": {"y": -0.2}, "angular": {"z": 0.5}})
    twist = moving(peer, "/pushed/odom", "yaw", 0.45)["twist"]["twist"]
    assert (twist["linear"]["x"], twist["linear"]["y"]) == pytest.approx((0.0, -0.2), abs=0.01)
    assert twist["angular"]["z"] == pytest.approx(0.5, abs=0.01)


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
