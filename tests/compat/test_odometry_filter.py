# SPDX-License-Identifier: BSD-3-Clause
"""The node ekf_localization_node: what it integrates."""

import math
import os
import signal
from collections.abc import Iterator
from pathlib import Path

import pytest

from ros_peer import Message, Messages, Peer
from ros_support import RosCore, start, stop, wait_until

PERIOD = 0.02  # s between messages
YAW_RATE_OF_IMU = [False] * 11 + [True] + [False] * 3


@pytest.fixture
def peer(roscore: RosCore, tmp_path: Path) -> Iterator[Peer]:
    with Peer(roscore, tmp_path / "peer.log") as peer:
        yield peer


def header(time: float) -> Message:
    return {"stamp": {"secs": int(time), "nsecs": round(time % 1 * 1e9)}}


def odometry(time: float, forward: float) -> Message:
    return {"header": header(time), "twist": {"twist": {"linear": {"x": forward}}}}


def imu(time: float, yaw_rate: float) -> Message:
    return {"header": header(time), "angular_velocity": {"z": yaw_rate}}


@pytest.fixture
def node(roscore: RosCore) -> Iterator[str]:
    """Yield the name of a node that integrates /odom and the yaw rate of /imu."""
    name = "ekf_localization"
    for parameter, value in (("odom0", "/odom"), ("imu0", "/imu"), ("imu0_config", YAW_RATE_OF_IMU)):
        roscore.set_param(f"/{name}/{parameter}", value)
    process = start(["rosrun", "robot_localization", "ekf_localization_node", f"__name:={name}"], roscore.env)
    wait_until(lambda: {"/odom", "/imu"} <= roscore.state()["subscribers"].keys(), "its subscribers")
    yield f"/{name}"
    stop(process)


def test_a_node_that_is_late_loses_no_message(roscore: RosCore, peer: Peer, node: str) -> None:
    """Stopped while a robot drives 1 m ahead, turns by 1 rad, drives 1 m again and stands: more than it had queued."""
    filtered = Messages(peer, "/odometry/filtered", "nav_msgs/Odometry")
    time = 10.0

    def move(seconds: float, forward: float, yaw_rate: float) -> None:
        nonlocal time
        for _ in range(round(seconds / PERIOD)):
            time += PERIOD
            peer.publish("/imu", "sensor_msgs/Imu", imu(time, yaw_rate))
            peer.publish("/odom", "nav_msgs/Odometry", odometry(time, forward))

    def is_connected() -> bool:
        move(PERIOD, 0.0, 0.0)
        return bool(peer.received("/odometry/filtered"))

    wait_until(is_connected, "the first message")
    pid = roscore.pid_of(node)
    os.kill(pid, signal.SIGSTOP)
    try:
        move(0.2, 5.0, 0.0)
        move(0.2, 0.0, 5.0)
        move(0.2, 5.0, 0.0)
        move(0.3, 0.0, 0.0)
        peer.call("/rosout/get_loggers")  # returns when all is sent
    finally:
        os.kill(pid, signal.SIGCONT)
    last = time - 1.5 * PERIOD  # at 30 Hz it publishes every other message
    pose = filtered.next(lambda message: message["header"]["stamp"] > last, "the last message")["pose"]["pose"]
    assert pose["position"]["x"] == pytest.approx(1.0 + math.cos(1.0), abs=1e-6)
    assert pose["position"]["y"] == pytest.approx(math.sin(1.0), abs=1e-6)
    assert 2 * math.atan2(pose["orientation"]["z"], pose["orientation"]["w"]) == pytest.approx(1.0, abs=1e-6)


def turned(roscore: RosCore, peer: Peer, message: Message) -> float:
    """Return the heading after a second of this message of the IMU, and of odometry at rest."""
    filtered = Messages(peer, "/odometry/filtered", "nav_msgs/Odometry")
    time = 10.0

    def send(more: Message) -> None:
        nonlocal time
        time += PERIOD
        peer.publish("/imu", "sensor_msgs/Imu", {**more, "header": header(time)})
        peer.publish("/odom", "nav_msgs/Odometry", odometry(time, 0.0))

    def is_connected() -> bool:
        send({"orientation": message["orientation"]})
        return bool(peer.received("/odometry/filtered"))

    wait_until(is_connected, "the first message")
    for _ in range(round(1.0 / PERIOD)):
        send(message)
    for _ in range(10):
        send({"orientation": message["orientation"]})
    last = time - 1.5 * PERIOD
    turn = filtered.next(lambda found: found["header"]["stamp"] > last, "the last message")["pose"]["pose"][
        "orientation"
    ]
    return 2 * math.atan2(turn["z"], turn["w"])


@pytest.mark.parametrize("roll", [0.0, 0.5])
def test_on_a_slope_the_rates_about_all_axes_turn_the_robot(roscore: RosCore, peer: Peer, roll: float) -> None:
    """Rolled by an angle, a turn of 0.4 rad/s about the vertical has parts about y and z of the IMU."""
    name = "ekf_localization"
    configuration = [False] * 3 + [True] * 2 + [False] * 4 + [True] * 3 + [False] * 3
    for parameter, value in (("odom0", "/odom"), ("imu0", "/imu"), ("imu0_config", configuration)):
        roscore.set_param(f"/{name}/{parameter}", value)
    process = start(["rosrun", "robot_localization", "ekf_localization_node", f"__name:={name}"], roscore.env)
    try:
        wait_until(lambda: {"/odom", "/imu"} <= roscore.state()["subscribers"].keys(), "its subscribers")
        rates = {"y": 0.4 * math.sin(roll), "z": 0.4 * math.cos(roll)}
        tilted = {"x": math.sin(roll / 2), "y": 0.0, "z": 0.0, "w": math.cos(roll / 2)}
        message = {"angular_velocity": rates, "orientation": tilted}
        assert turned(roscore, peer, message) == pytest.approx(0.4, abs=1e-6)
    finally:
        stop(process)
