# SPDX-License-Identifier: BSD-3-Clause
"""The distributions of ROS 2 that differ from Jazzy, with which the other tests are: Humble's types, Kilted's nodes."""

import json
import os
import subprocess
import sys
from pathlib import Path
from typing import Any

import pytest

from bubblesim import _core
from node_support import Node, write
from ros2_peer import KILTED_PEERS, PEERS, Domain, Ros2Peer, has_ros2, peer_environment
from ros_support import wait_until

codec = _core.messages
ROS2 = codec.RosVersion.ROS2
NODE = "/sim_ros2_interface"

pytestmark = has_ros2

# By rosbags, which has the definitions of each distribution: fields by type, and a message with numbers that count up.
THEIRS = """
import json, sys
from rosbags.typesys import Stores, get_typestore
store = get_typestore(Stores[sys.argv[1]])
fields = {name: [field for field, _ in parts[1]] for name, parts in store.fielddefs.items()}
Range, Header, Time = (store.types[name] for name in (
    'sensor_msgs/msg/Range', 'std_msgs/msg/Header', 'builtin_interfaces/msg/Time'))
numbers = dict(zip(fields['sensor_msgs/msg/Range'][1:], [1, 0.25, 0.5, 8.0, 2.5, 0.125]))
message = Range(header=Header(stamp=Time(sec=1, nanosec=2), frame_id='sonar'), **numbers)
print(json.dumps([fields, bytes(store.serialize_cdr(message, 'sensor_msgs/msg/Range')).hex()]))
"""
OURS = """
import json
from bubblesim import _core
codec = _core.messages
ROS2 = codec.RosVersion.ROS2
fields = {name: list(codec.fields(name, ROS2)) for name in codec.message_names(ROS2)}
message = {'header': {'stamp': {'sec': 1, 'nanosec': 2}, 'frame_id': 'sonar'}}
message.update(zip(fields['sensor_msgs/Range'][1:], [1, 0.25, 0.5, 8.0, 2.5, 0.125]))
print(json.dumps([fields, codec.encode_ros2('sensor_msgs/Range', message).hex()]))
"""


def printed_by(python: Path | str, code: str, env: dict[str, str], *arguments: str) -> Any:
    run = subprocess.run([python, "-c", code, *arguments], env=env, capture_output=True, text=True, check=True)
    return json.loads(run.stdout.splitlines()[-1])


@pytest.mark.parametrize("distribution", ["humble", "iron", "jazzy", "kilted"])
def test_types_have_the_fields_of_the_distribution(distribution: str, ros2_domain: Domain) -> None:
    store = f"ROS2_{distribution.upper()}"
    their_fields, their_bytes = printed_by(PEERS / "bin" / "python", THEIRS, peer_environment(ros2_domain), store)
    our_fields, our_bytes = printed_by(sys.executable, OURS, {**os.environ, "ROS_DISTRO": distribution})
    ours = {name.replace("/", "/msg/"): fields for name, fields in our_fields.items()}
    for fields in their_fields.values():
        if fields == ["structure_needs_at_least_one_member"]:
            fields.clear()
    compared = ours.keys() & their_fields.keys()
    assert len(compared) > 120
    assert {name for name in compared if ours[name] != their_fields[name]} == set()
    assert their_bytes == "00010000" + our_bytes
    assert ("variance" in ours["sensor_msgs/msg/Range"]) == (distribution != "humble")


def test_fields_without_a_value_have_ros2s_defaults(ros2_peer: Ros2Peer) -> None:
    names = [name for name in codec.message_names(ROS2) if name.replace("/", "/msg/") in known_to_peers()]
    assert len(names) > 90
    for name in names:
        theirs, read = defaults(ros2_peer, name.replace("/", "/msg/"), codec.encode_ros2(name, {}))
        assert read == theirs, name
    assert codec.default("geometry_msgs/Pose", codec.TimeForm.FLOAT, ROS2)["orientation"]["w"] == 1.0


def defaults(peer: Ros2Peer, kind: str, ours: bytes) -> tuple[Any, Any]:
    """Return ROS 2's message with defaults, and what ROS 2 reads in ours: bytes between the fields have any value."""
    theirs = peer.encode(kind, {})
    return peer.decode(kind, theirs), peer.decode(kind, theirs[:4] + ours)


def known_to_peers() -> set[str]:
    return {f"{file.parents[1].name}/msg/{file.stem}" for file in (PEERS / "share").glob("*/msg/*.msg")}


@pytest.mark.parametrize("name", ["Defaults", "Strings", "Arrays", "UnboundedSequences", "BoundedSequences"])
def test_defaults_of_each_kind_in_a_users_own_type(name: str, ros2_peer: Ros2Peer) -> None:
    code = "import json, sys\nfrom bubblesim import _core\n"
    code += "print(json.dumps(_core.messages.encode_ros2(sys.argv[1], {}).hex()))"
    env = {**os.environ, "ROS_PACKAGE_PATH": str(PEERS / "share")}
    ours = bytes.fromhex(printed_by(sys.executable, code, env, f"test_msgs/{name}"))
    theirs, read = defaults(ros2_peer, f"test_msgs/msg/{name}", ours)
    assert read == theirs


SCRIPT = """
    def sysCall_init():
        self.out = simROS2.createPublisher('/out', 'sensor_msgs/LaserScan')
        simROS2.createSubscription('/in', 'geometry_msgs/Twist', 'on_in')
        simROS2.createService('/paint', 'std_srvs/SetBool', 'paint')
        self.client = simROS2.createClient('/switch', 'std_srvs/SetBool')

    def on_in(message):
        response = simROS2.call(self.client, {'data': True})
        print('received', message['linear']['x'], response['message'], flush=True)

    def paint(request):
        return {'success': request['data'], 'message': 'painted'}

    def sysCall_sensing():
        simROS2.publish(self.out, {'ranges': [1.0, 2.0, 3.0], 'range_max': 8.0})
"""


def test_nodes_of_kilted_use_topics_services_and_parameters(ros2_domain: Domain, tmp_path: Path) -> None:
    file = write(tmp_path / "script.py", SCRIPT)
    options = ["ball", "--ros=2", "--child-script", f"/Ball={file}"]
    with (
        Node(ros2_domain.env(), tmp_path / "log", *options) as node,
        Ros2Peer(ros2_domain, tmp_path / "peer.log", peers=KILTED_PEERS) as peer,
    ):
        scan = peer.next("/out", "sensor_msgs/msg/LaserScan")
        assert (scan["ranges"], scan["range_max"]) == ([1.0, 2.0, 3.0], 8.0)
        answer = peer.call("/paint", "std_srvs/srv/SetBool", data=True)
        assert answer == {"success": True, "message": "painted"}
        peer.serve("/switch", "std_srvs/srv/SetBool", success=True, message="switched")
        peer.publish("/in", "geometry_msgs/msg/Twist", {"linear": {"x": 0.5}})
        node.wait_for_output("received 0.5 switched")
        assert peer.next("/clock", "rosgraph_msgs/msg/Clock")["clock"]["sec"] >= 0
        (value,) = peer.call(f"{NODE}/get_parameters", "rcl_interfaces/srv/GetParameters", names=["use_sim_time"])[
            "values"
        ]
        assert (value["type"], value["bool_value"]) == (1, False)
        wait_until(lambda: NODE in peer.graph()["nodes"], "the node's name")
        (publisher,) = peer.graph()["topics"]["/out"]["publishers"]
        assert (publisher["node"], publisher["type_hash"]) == (NODE, codec.type_hash("sensor_msgs/LaserScan", ROS2))
