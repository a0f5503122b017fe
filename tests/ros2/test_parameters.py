# SPDX-License-Identifier: BSD-3-Clause
"""Parameters of the node, read and set by nodes of ROS 2, and its log on /rosout."""

from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest

from node_support import Node, run_sim, write
from ros2_peer import Domain, Ros2Peer
from ros_support import wait_until

NODE = "/sim_ros2_interface"
BOOL, INTEGER, DOUBLE, STRING, DOUBLES = 1, 2, 3, 4, 8  # rcl_interfaces/msg/ParameterType

SCRIPT = """
    def sysCall_init():
        simROS2.setParamDouble('gain', 0.5)
        self.last = None

    def sysCall_actuation():
        found, gain = simROS2.getParamDouble('gain', 0.0)
        if gain != self.last:
            print('gain', found, gain, flush=True)
            self.last = gain
"""


@pytest.fixture
def node(ros2_domain: Domain, tmp_path: Path) -> Iterator[Node]:
    file = write(tmp_path / "script.py", SCRIPT)
    options = ["--ros=2", "--child-script", f"/Ball={file}", "_robot.name:=Bob", "_robot.wheels:=4"]
    with Node(ros2_domain.env(), tmp_path / "log", "ball", *options) as running:
        running.wait_for_output("gain True 0.5")
        yield running


def call(peer: Ros2Peer, name: str, kind: str, **request: Any) -> Any:
    return peer.call(f"{NODE}/{name}", f"rcl_interfaces/srv/{kind}", **request)


def value(kind: int, **values: Any) -> dict[str, Any]:
    return {"type": kind, **values}


def test_parameters_are_listed_and_read(node: Node, ros2_peer: Ros2Peer) -> None:
    listed = call(ros2_peer, "list_parameters", "ListParameters")["result"]
    assert listed == {"names": ["gain", "robot.name", "robot.wheels", "use_sim_time"], "prefixes": ["robot"]}
    assert call(ros2_peer, "list_parameters", "ListParameters", depth=1)["result"]["names"] == ["gain", "use_sim_time"]
    below = call(ros2_peer, "list_parameters", "ListParameters", prefixes=["robot"])
    assert below["result"]["names"] == ["robot.name", "robot.wheels"]
    names = ["gain", "robot.name", "robot.wheels", "use_sim_time", "none"]
    values = call(ros2_peer, "get_parameters", "GetParameters", names=names)["values"]
    assert [each["type"] for each in values] == [DOUBLE, STRING, INTEGER, BOOL, 0]
    assert (values[0]["double_value"], values[1]["string_value"], values[2]["integer_value"]) == (0.5, "Bob", 4)
    types = call(ros2_peer, "get_parameter_types", "GetParameterTypes", names=names)["types"]
    assert list(types) == [DOUBLE, STRING, INTEGER, BOOL, 0]
    (described,) = call(ros2_peer, "describe_parameters", "DescribeParameters", names=["gain"])["descriptors"]
    assert (described["name"], described["type"], described["read_only"]) == ("gain", DOUBLE, False)


def test_a_script_sees_what_ros2_sets_and_others_are_notified(node: Node, ros2_peer: Ros2Peer) -> None:
    ros2_peer.received("/parameter_events", "rcl_interfaces/msg/ParameterEvent")
    wait_until(lambda: len(ros2_peer.graph()["topics"]["/parameter_events"]["subscribers"]) > 0, "the subscriber")
    parameters = [{"name": "gain", "value": value(DOUBLE, double_value=2.5)}]
    results = call(ros2_peer, "set_parameters", "SetParameters", parameters=parameters)["results"]
    assert results == [{"successful": True, "reason": ""}]
    node.wait_for_output("gain True 2.5")
    event = ros2_peer.wait_for(
        "/parameter_events", "", lambda message: message["node"] == NODE and message["changed_parameters"], "the event"
    )
    (changed,) = event["changed_parameters"]
    assert (changed["name"], changed["value"]["double_value"]) == ("gain", 2.5)


def test_lists_are_kept(node: Node, ros2_peer: Ros2Peer) -> None:
    parameters = [{"name": "limits", "value": value(DOUBLES, double_array_value=[0.5, 1.5])}]
    result = call(ros2_peer, "set_parameters_atomically", "SetParametersAtomically", parameters=parameters)["result"]
    assert result["successful"]
    (limits,) = call(ros2_peer, "get_parameters", "GetParameters", names=["limits"])["values"]
    assert (limits["type"], list(limits["double_array_value"])) == (DOUBLES, [0.5, 1.5])


def test_use_sim_time_is_a_bool_and_works_at_once(node: Node, ros2_peer: Ros2Peer) -> None:
    wrong = [{"name": "use_sim_time", "value": value(STRING, string_value="yes")}]
    (result,) = call(ros2_peer, "set_parameters", "SetParameters", parameters=wrong)["results"]
    assert result == {"successful": False, "reason": "use_sim_time must be true or false"}
    right = [{"name": "use_sim_time", "value": value(BOOL, bool_value=True)}]
    (result,) = call(ros2_peer, "set_parameters", "SetParameters", parameters=right)["results"]
    assert result["successful"]


def test_the_log_of_the_node_is_on_rosout(node: Node, ros2_peer: Ros2Peer) -> None:
    ros2_peer.received("/rosout", "rcl_interfaces/msg/Log", transient_local=True, depth=1000)
    line = ros2_peer.wait_for("/rosout", "", lambda message: "load succeeded" in message["msg"], "the first line")
    assert (line["name"], line["level"]) == ("sim_ros2_interface", 20)


@pytest.mark.parametrize(
    ("env", "reported"),
    [
        ({"ROS_AUTOMATIC_DISCOVERY_RANGE": "HOUSE"}, "must be OFF, LOCALHOST, SUBNET or SYSTEM_DEFAULT, found 'HOUSE'"),
        ({"ROS_STATIC_PEERS": "nobody.invalid"}, "ROS_STATIC_PEERS: 'nobody.invalid' has no IPv4 address"),
    ],
)
def test_an_environment_that_is_none_is_refused(ros2_domain: Domain, env: dict[str, str], reported: str) -> None:
    run = run_sim("ball", "--ros=2", "--until=0.1", env=ros2_domain.env() | env)
    assert (run.returncode, reported in run.stderr) == (2, True)


@pytest.mark.parametrize(
    ("env", "is_seen"),
    [
        ({"ROS_AUTOMATIC_DISCOVERY_RANGE": "SUBNET"}, True),
        ({"ROS_AUTOMATIC_DISCOVERY_RANGE": "SUBNET", "ROS_STATIC_PEERS": "127.0.0.1"}, True),
        ({"ROS_AUTOMATIC_DISCOVERY_RANGE": "LOCALHOST", "ROS_STATIC_PEERS": "localhost;127.0.0.1"}, True),
        ({"ROS_LOCALHOST_ONLY": "1"}, True),
        ({"ROS_AUTOMATIC_DISCOVERY_RANGE": "OFF"}, False),
    ],
)
@pytest.mark.parametrize("peers", ["SUBNET", "LOCALHOST"])
def test_ranges_of_discovery(
    ros2_domain: Domain, tmp_path: Path, env: dict[str, str], is_seen: bool, peers: str
) -> None:
    with (
        Ros2Peer(ros2_domain, tmp_path / "peer.log", ROS_AUTOMATIC_DISCOVERY_RANGE=peers) as peer,
        Node(ros2_domain.env() | env, tmp_path / "log", "ball", "--ros=2") as node,
    ):
        node.wait_for_output("load succeeded")
        if is_seen:
            wait_until(lambda: NODE in peer.graph()["nodes"], "the node")
        else:
            assert NODE not in peer.graph()["nodes"]
