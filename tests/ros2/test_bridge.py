# SPDX-License-Identifier: BSD-3-Clause
"""`bubblesim bridge`: nodes of ROS 1 and of ROS 2 with nothing but the bridge between them."""

import itertools
import re
import subprocess
import time
from collections.abc import Callable, Iterator
from pathlib import Path

import pytest

from node_support import Background
from ros2_peer import Domain, Ros2Peer
from ros_peer import Peer
from ros_support import DEADLINE, RosCore, start, wait_until
from service_caller import ServiceCaller

PROGRAM = "bubblesim"
SCAN = {"ranges": [1.0, 2.5, 3.0], "angle_min": -1.0, "angle_max": 1.0, "range_max": 30.0}


class Bridge(Background):
    """The program in the background."""

    def __init__(self, env: dict[str, str], log: Path, *arguments: str) -> None:
        self._log = log
        with log.open("w") as output:
            self.process = start([PROGRAM, "bridge", *arguments], env, stdout=output, stderr=subprocess.STDOUT)

    @property
    def output(self) -> str:
        return self._log.read_text(encoding="utf-8")

    def wait_for_output(self, text: str) -> None:
        wait_until(lambda: text in self.output, f"'{text}' in the output")


@pytest.fixture
def ros1(roscore: RosCore, tmp_path: Path) -> Iterator[Peer]:
    with Peer(roscore, tmp_path / "ros1_peer.log") as peer:
        yield peer


@pytest.fixture
def bridge(roscore: RosCore, ros2_domain: Domain, tmp_path: Path) -> Iterator[Callable[..., Bridge]]:
    started = []

    def begin(*arguments: str) -> Bridge:
        env = roscore.env | {"ROS_DOMAIN_ID": str(ros2_domain.number)}
        started.append(Bridge(env, tmp_path / "bridge.log", *arguments))
        return started[-1]

    yield begin
    for each in started:
        each.__exit__(None, None, None)


def test_topics_pass_both_ways(bridge: Callable[..., Bridge], ros1: Peer, ros2_peer: Ros2Peer) -> None:
    program = bridge()
    ros2_peer.received("/scan", "sensor_msgs/msg/LaserScan")
    ros1.publish("/scan", "sensor_msgs/LaserScan", {"header": {"frame_id": "laser"}, **SCAN})
    program.wait_for_output("info: passing topic /scan (sensor_msgs/LaserScan) to ROS 2")
    scan = ros2_peer.wait_for("/scan", "", lambda m: m["ranges"] == SCAN["ranges"], "the scan")
    assert (scan["header"]["frame_id"], scan["range_max"]) == ("laser", 30.0)
    ros1.received("/cmd_vel", "geometry_msgs/Twist")
    ros2_peer.publish("/cmd_vel", "geometry_msgs/msg/Twist", {"linear": {"x": 0.5}, "angular": {"z": -1.5}})
    wait_until(lambda: ros1.received("/cmd_vel") != [], "the command")
    (command,) = ros1.received("/cmd_vel")
    assert (command["linear"]["x"], command["angular"]["z"]) == (0.5, -1.5)


def test_a_topic_that_both_sides_publish_does_not_go_round_in_circles(
    bridge: Callable[..., Bridge], ros1: Peer, ros2_peer: Ros2Peer
) -> None:
    bridge()
    ros1.received("/speed", "std_msgs/Float32")
    ros2_peer.received("/speed", "std_msgs/msg/Float32")
    numbers = itertools.count()
    sent: dict[bool, set[float]] = {True: set(), False: set()}

    def have_passed() -> bool:
        """The peers receive their own messages, so they do not wait until the bridge has subscribed."""
        for peer, kind, of_ros1 in ((ros1, "std_msgs/Float32", True), (ros2_peer, "std_msgs/msg/Float32", False)):
            sent[of_ros1].add(float(next(numbers)))
            peer.publish("/speed", kind, {"data": max(sent[of_ros1])})
        time.sleep(0.1)
        arrived = [{each["data"] for each in peer.received("/speed")} for peer in (ros1, ros2_peer)]
        return bool(arrived[0] & sent[False] and arrived[1] & sent[True])

    wait_until(have_passed, "messages of the other sides")
    time.sleep(1.0)
    for peer in (ros1, ros2_peer):
        received = [message["data"] for message in peer.received("/speed")]
        assert len(received) == len(set(received))


def test_static_transforms_reach_late_subscribers(
    bridge: Callable[..., Bridge], roscore: RosCore, ros1: Peer, ros2_peer: Ros2Peer
) -> None:
    bridge()
    with roscore.publishing("/map_metadata", "nav_msgs/MapMetaData", "-l", "{width: 7}"):
        wait_until(lambda: "/map_metadata" in ros2_peer.graph()["topics"], "the topic")
        time.sleep(1.0)  # the message has passed before the subscriber comes
        ros2_peer.received("/map_metadata", "nav_msgs/msg/MapMetaData", transient_local=True)
        wait_until(lambda: ros2_peer.received("/map_metadata") != [], "the message")
    assert ros2_peer.received("/map_metadata")[0]["width"] == 7


def test_services_pass_both_ways(
    bridge: Callable[..., Bridge], roscore: RosCore, ros1: Peer, ros2_peer: Ros2Peer, tmp_path: Path
) -> None:
    program = bridge()
    server = tmp_path / "server.py"
    server.write_text(
        "import rospy, std_srvs.srv as srv\n"
        "rospy.init_node('server')\n"
        "rospy.Service('/one', srv.SetBool, lambda r: srv.SetBoolResponse(r.data, 'of ROS 1'))\n"
        "rospy.spin()\n"
    )
    process = start(["/usr/bin/python3", str(server)], roscore.env)
    try:
        assert ros2_peer.call("/one", "std_srvs/srv/SetBool", data=True) == {"success": True, "message": "of ROS 1"}
    finally:
        process.kill()
        process.wait()
    ros2_peer.serve("/two", "std_srvs/srv/Trigger", success=True, message="of ROS 2")
    program.wait_for_output("info: offering service /two (std_srvs/Trigger) to ROS 1")
    with ServiceCaller(roscore) as call:
        wait_until(lambda: "/two" in roscore.state()["services"], "the service")
        assert call("/two") == {"success": True, "message": "of ROS 2"}


def test_only_what_is_named_passes(
    bridge: Callable[..., Bridge], roscore: RosCore, ros1: Peer, ros2_peer: Ros2Peer
) -> None:
    bridge("/wanted")
    for topic in ("/wanted", "/other"):
        ros2_peer.received(topic, "std_msgs/msg/Float32")
    with (
        roscore.publishing("/wanted", "std_msgs/Float32", "-r", "10", "data: 1.0"),
        roscore.publishing("/other", "std_msgs/Float32", "-r", "10", "data: 2.0"),
    ):
        wait_until(lambda: len(ros2_peer.received("/wanted")) > 5, "messages")
    assert ros2_peer.received("/other") == []


def test_what_has_no_counterpart_is_reported_once(bridge: Callable[..., Bridge], roscore: RosCore, ros1: Peer) -> None:
    program = bridge()
    with roscore.publishing("/when", "std_msgs/Time", "-r", "10", "data: {secs: 1, nsecs: 2}"):
        program.wait_for_output("warning: /when of ROS 1 is not passed: std_msgs/Time is not listed")
        time.sleep(2.5)
    assert len(re.findall("/when", program.output)) == 1


def test_names_that_are_none_are_refused(bridge: Callable[..., Bridge]) -> None:
    program = bridge("scan")
    assert program.process.wait(timeout=DEADLINE) == 2
    assert "error: expected names of topics and services such as /scan, found 'scan'" in program.output


def test_ctrl_c_ends_it(bridge: Callable[..., Bridge]) -> None:
    program = bridge()
    program.wait_for_output("load succeeded: node /ros_bridge in domain ")
    program.process.send_signal(2)
    assert program.process.wait(timeout=DEADLINE) == 0
