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
