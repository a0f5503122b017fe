# SPDX-License-Identifier: BSD-3-Clause
"""The Kobuki of the TurtleBot 2: its drive, odometry, bumpers, cliff sensors and IMU, on its own topics."""

import math
from collections.abc import Callable
from typing import Any

import pytest

from bubblesim import _core
from bubblesim.gazebo_plugins.drives.kobuki_events import bumpers_pressed, cliff_reading
from node_support import write
from ros_peer import Messages, Peer

WHEEL, TRACK = 0.035, 0.23  # m
INERTIA = "<inertia><ixx>{0}</ixx><iyy>{0}</iyy><izz>{0}</izz></inertia>"
SMOOTH = "<surface><friction><ode><mu>0</mu><mu2>0</mu2></ode></friction></surface>"


def wheel(side: str, y: float) -> str:
    shape = f"<geometry><sphere><radius>{WHEEL}</radius></sphere></geometry>"
    inertial = f"<inertial><mass>0.1</mass>{INERTIA.format(5e-5)}</inertial>"
    return (
        f'<link name="wheel_{side}"><pose>0 {y} {WHEEL} 0 0 0</pose>{inertial}'
        f'<collision name="rim">{shape}</collision></link>'
        f'<joint name="wheel_{side}_joint" type="revolute"><parent>base</parent><child>wheel_{side}</child>'
        "<axis><xyz>0 1 0</xyz><limit><lower>-1e16</lower><upper>1e16</upper></limit></axis></joint>"
    )


def caster(name: str, x: float) -> str:
    shape = "<geometry><sphere><radius>0.0175</radius></sphere></geometry>"
    return f'<collision name="{name}"><pose>{x} 0 0.0175 0 0 0</pose>{shape}{SMOOTH}</collision>'


def cliff_sensor(side: str, x: float, y: float) -> str:
    scan = "<horizontal><samples>1</samples><min_angle>0</min_angle><max_angle>0</max_angle></horizontal>"
    return (
        f'<sensor name="cliff_{side}" type="ray"><pose>{x} {y} 0.0214 0 {math.pi / 2} 0</pose>'
        f"<ray><scan>{scan}</scan><range><min>0.01</min><max>0.15</max></range></ray></sensor>"
    )


def kobuki(name: str, pose: str, **parameters: object) -> str:
    elements = "".join(f"<{key}>{value}</{key}>" for key, value in parameters.items())
    return (
        f'<model name="{name}"><pose>{pose}</pose><link name="base">'
        f"<inertial><pose>0 0 0.05 0 0 0</pose><mass>2.4</mass>{INERTIA.format(0.03)}</inertial>"
        '<collision name="body"><pose>0 0 0.065 0 0 0</pose>'
        "<geometry><cylinder><radius>0.176</radius><length>0.09</length></cylinder></geometry></collision>"
        f"{caster('front', 0.115)}{caster('back', -0.115)}"
        f"{cliff_sensor('left', 0.083, 0.136)}{cliff_sensor('front', 0.156, 0)}{cliff_sensor('right', 0.083, -0.136)}"
        '<sensor name="bumpers" type="contact"><contact><collision>body</collision></contact></sensor>'
        '<sensor name="gyro" type="imu"/></link>'
        f"{wheel('left', TRACK / 2)}{wheel('right', -TRACK / 2)}"
        f'<plugin name="kobuki" filename="libgazebo_ros_kobuki.so">{elements}'
        "<publish_tf>1</publish_tf><left_wheel_joint_name>wheel_left_joint</left_wheel_joint_name>"
        "<right_wheel_joint_name>wheel_right_joint</right_wheel_joint_name>"
        f"<wheel_separation>{TRACK}</wheel_separation><wheel_diameter>{2 * WHEEL}</wheel_diameter><torque>2</torque>"
        "<cliff_sensor_left_name>cliff_left</cliff_sensor_left_name>"
        "<cliff_sensor_center_name>cliff_front</cliff_sensor_center_name>"
        "<cliff_sensor_right_name>cliff_right</cliff_sensor_right_name>"
        "<cliff_detection_threshold>0.04</cliff_detection_threshold>"
        "<bumper_name>bumpers</bumper_name><imu_name>gyro</imu_name></plugin></model>"
    )


def block(name: str, pose: str, size: str) -> str:
    shape = f'<collision name="c"><geometry><box><size>{size}</size></box></geometry></collision>'
    return f'<model name="{name}"><static>true</static><pose>{pose}</pose><link name="link">{shape}</link></model>'


PLANE = '<collision name="c"><geometry><plane><normal>0 0 1</normal></plane></geometry></collision>'
WORLD = (
    '<sdf version="1.9"><world name="home">'
    f'<model name="floor"><static>true</static><link name="link">{PLANE}</link></model>'
    + kobuki("mobile_base", "0 0 0 0 0 0", velocity_command_timeout=0.6)
    + block("wall", "0.25 3 0.5 0 0 0", "0.1 2 1")
    + kobuki("bumps", "0 3 0 0 0 0", velocity_command_timeout=1e6, robotNamespace="bumps")
    + kobuki("motors", "0 -3 0 0 0 0", velocity_command_timeout=1e6, robotNamespace="motors")
    + block("table", "0 6 0.25 0 0 0", "1 1 0.5")
    + kobuki("edge", "0.4 6 0.5 0 0 0", velocity_command_timeout=1e6, robotNamespace="edge")
    + "</world></sdf>"
)


@pytest.fixture(scope="module")
def peer(run: Callable[..., Any], tmp_path_factory: pytest.TempPathFactory) -> Peer:
    peer: Peer = run(write(tmp_path_factory.mktemp("kobuki") / "home.sdf", WORLD), "--speed", "2").peer
    return peer


class Odometry(Messages):
    """The odometry of a robot, which is connected: a motion may last a moment only."""

    def __init__(self, peer: Peer, namespace: str = "") -> None:
        topic = f"{namespace}/odom"
        peer.next(topic, "nav_msgs/Odometry")
        super().__init__(peer, topic, "nav_msgs/Odometry")


def test_it_drives_until_its_commands_are_too_old_and_resets_its_odometry(peer: Peer) -> None:
    odometry = Odometry(peer)
    peer.drive("/mobile_base/commands/velocity", 0.2, 0.0)
    odometry.next(lambda odom: abs(odom["twist"]["twist"]["linear"]["x"] - 0.2) < 0.01, "0.2 m/s")
    stopped = odometry.next(lambda odom: abs(odom["twist"]["twist"]["linear"]["x"]) < 0.001, "it to stop by itself")
    assert (stopped["header"]["frame_id"], stopped["child_frame_id"]) == ("odom", "base_footprint")
    # 0.6 s and at most a step or two of 50 ms at 0.2 m/s, minus the acceleration time.
    assert stopped["pose"]["pose"]["position"]["x"] == pytest.approx(0.12, abs=0.03)
    states = peer.next("/joint_states", "sensor_msgs/JointState")
    assert states["name"] == ["wheel_left_joint", "wheel_right_joint"]
    peer.publish("/mobile_base/commands/reset_odometry", "std_msgs/Empty", {})
    odometry.next(lambda odom: abs(odom["pose"]["pose"]["position"]["x"]) < 1e-3, "the odometry to start over")


def test_its_heading_is_that_of_its_gyroscope(peer: Peer) -> None:
    odometry = Odometry(peer)
    peer.drive("/mobile_base/commands/velocity", 0.0, 1.0)
    turning = odometry.next(lambda odom: odom["twist"]["twist"]["angular"]["z"] > 0.9, "1 rad/s to the left")
    assert turning["twist"]["twist"]["angular"]["z"] == pytest.approx(1.0, rel=0.05)
    imu = peer.next("/mobile_base/sensors/imu_data", "sensor_msgs/Imu")
    assert imu["linear_acceleration"]["z"] == pytest.approx(9.8, abs=0.3)
    assert imu["orientation_covariance"][0] > 1e5 > imu["orientation_covariance"][8]


def test_motors_without_power_stand_still(peer: Peer) -> None:
    """Its command stays valid, and each step waits for the one before: two topics have no common order."""
    odometry = Odometry(peer, "/motors")

    def at(turning: float) -> None:
        odometry.next(lambda odom: abs(odom["twist"]["twist"]["angular"]["z"] - turning) < 0.05, f"{turning} rad/s")

    peer.drive("/motors/mobile_base/commands/velocity", 0.0, 1.0)
    at(1.0)
    peer.publish("/motors/mobile_base/commands/motor_power", "kobuki_msgs/MotorPower", {"state": 0})
    at(0.0)
    assert peer.next("/motors/odom", count=10)["twist"]["twist"]["angular"]["z"] == pytest.approx(0, abs=1e-3)
    peer.publish("/motors/mobile_base/commands/motor_power", "kobuki_msgs/MotorPower", {"state": 1})
    at(1.0)


def test_a_wall_presses_and_releases_the_bumper_in_the_middle(peer: Peer) -> None:
    events = Messages(peer, "/bumps/mobile_base/events/bumper", "kobuki_msgs/BumperEvent")
    peer.drive("/bumps/mobile_base/commands/velocity", 0.1, 0.0)
    pressed = events.next(lambda event: event["state"] == 1, "a press")
    assert pressed["bumper"] == 1
    peer.drive("/bumps/mobile_base/commands/velocity", -0.1, 0.0)
    released = events.next(lambda event: event["state"] == 0, "a release")
    assert released["bumper"] == 1


def test_the_edge_of_a_table_is_a_cliff_until_there_is_floor_again(peer: Peer) -> None:
    events = Messages(peer, "/edge/mobile_base/events/cliff", "kobuki_msgs/CliffEvent")
    cliff = events.next(lambda event: event["state"] == 1, "a cliff")
    assert (cliff["sensor"], cliff["bottom"]) == (1, 0), "0.156 m ahead of 0.4 m there is no table, nor floor in range"
    peer.drive("/edge/mobile_base/commands/velocity", -0.1, 0.0)
    floor = events.next(lambda event: event["state"] == 0, "the floor")
    assert floor["sensor"] == 1


def test_each_bumper_is_a_sixth_of_a_turn_wide() -> None:
    still = [1.0, 2.0, 0.5, 0.0, 0.0, math.sin(0.4), math.cos(0.4)]  # turned by 0.8 rad

    def pressed(angle: float, height: float = 0.05) -> set[str]:
        towards = [-math.cos(0.8 + angle), -math.sin(0.8 + angle), 0.0]
        return bumpers_pressed(still, [([1.0, 2.0, 0.5 + height], towards)])

    degrees = math.pi / 180
    assert [pressed(angle * degrees) for angle in (-95, -85, -31, -29, 29, 31, 85, 95)] == [
        set(), {"right"}, {"right"}, {"center"}, {"center"}, {"left"}, {"left"}, set()
    ]  # fmt: skip
    assert pressed(0.0, height=0.2) == set(), "above the bumper"
    assert bumpers_pressed(still, [([1.0, 2.0, 0.52], [0.0, 0.0, 1.0])]) == set(), "the floor"


def test_a_cliff_sensor_reads_less_the_farther_the_floor_is() -> None:
    assert cliff_reading(math.inf) == 0
    assert cliff_reading(0.0) == 0xFFFF, "what a uint16 holds"
    assert cliff_reading(2.0) == int(76123 * math.atan2(0.995, 2.0))


# Values from the code of other generators for kobuki_msgs: rosserial, rosnodejs, roslisp.
@pytest.mark.parametrize(
    ("name", "md5"),
    [
        ("BumperEvent", "ffe360cd50f14f9251d9844083e72ac5"),
        ("CliffEvent", "c5b106efbb1427a94f517c5e05f06295"),
        ("MotorPower", "8f77c0161e0f2021493136bb5f3f0e51"),
    ],
)
def test_its_messages_have_the_md5_of_the_kobukis_own(name: str, md5: str) -> None:
    assert _core.messages.type_hash(f"kobuki_msgs/{name}") == md5
