# SPDX-License-Identifier: BSD-3-Clause
"""Nodes that use another type for a topic or a service: reported in one line, however often they try."""

import socket
import struct
import subprocess
import xmlrpc.client
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

from bridge_probe import Probe
from node_support import NAME
from ros_support import DEADLINE, RosCore, start, stop, wait_until

FLOAT = "std_msgs/Float32 (md5 73fcbf46b49191e672908e50842a83d4)"
STRING = "std_msgs/String (md5 992ce8a1687cec8c8bd883ec73ca41d1)"
OTHER_FLOAT = "std_msgs/Float32 (md5 00000000000000000000000000000000)"
REBUILD = (
    "the definitions differ: build the messages of both nodes from the same definition, and start both after "
    "sourcing that workspace"
)


@contextmanager
def rospy_node(core: RosCore, code: str, log: Path) -> Iterator[None]:
    """Run a node /peer with `code`; its output goes to `log`."""
    head = "import rospy, std_msgs.msg, std_srvs.srv\nrospy.init_node('peer')\n"
    with log.open("w") as file:
        process = start(["/usr/bin/python3", "-c", head + code], core.env, stdout=file, stderr=subprocess.STDOUT)
        try:
            yield
        finally:
            stop(process)


def reported(probe: Probe) -> list[str]:
    """Return what the bridge and roscpp logged since the bridge connected."""
    return [line for line in probe.errors if "plugin 'ROSInterface': load " not in line]


def test_subscriber_of_another_type_is_reported_once(roscore: RosCore, tmp_path: Path) -> None:
    def attempts() -> int:
        return sum(file.read_text().count("unable to create subscriber") for file in tmp_path.rglob("peer*.log"))

    with Probe(roscore.env) as probe:
        probe.ask("advertise", "/speed", "float")
        wait_until(lambda: "/speed" in roscore.state()["publishers"], "the publisher")
        again = "s = rospy.Subscriber('/speed', std_msgs.msg.String); rospy.sleep(0.5); s.unregister()"
        with rospy_node(roscore, f"while not rospy.is_shutdown(): {again}", tmp_path / "peer"):
            wait_until(lambda: attempts() >= 2, "the peer to have tried twice")
    assert reported(probe) == [
        f"plugin 'ROSInterface': topic '/speed': node /peer subscribes to {STRING}, but this node publishes "
        f"{FLOAT}, so no messages are sent to it; use the same type in both"
    ]


def subscribe(node: tuple[str, int], caller: str) -> None:
    """Ask a node for /speed with another type, as roscpp does, and return when it has refused."""
    fields = [f"callerid={caller}", "topic=/speed", "type=std_msgs/String", f"md5sum={STRING[-33:-1]}"]
    header = b"".join(struct.pack("<I", len(field)) + field.encode() for field in fields)
    with socket.create_connection(node, timeout=DEADLINE) as connection:
        connection.sendall(struct.pack("<I", len(header)) + header)
        while connection.recv(1000):
            pass


def test_a_hundred_subscribers_are_reported_and_no_more(roscore: RosCore) -> None:
    with Probe(roscore.env) as probe:
        probe.ask("advertise", "/speed", "float")
        wait_until(lambda: "/speed" in roscore.state()["publishers"], "the publisher")
        master: Any = xmlrpc.client.ServerProxy(roscore.env["ROS_MASTER_URI"])
        node: Any = xmlrpc.client.ServerProxy(master.lookupNode("/test", NAME)[2])
        _, host, port = node.requestTopic("/test", "/speed", [["TCPROS"]])[2]
        for number in range(110):
            subscribe((host, port), f"/peer{number}")
        probe.wait_for(lambda: len(reported(probe)) >= 101, "the lines")
    assert [f"node /peer{n} subscribes" in line for n, line in enumerate(reported(probe)[:100])] == [True] * 100
    assert reported(probe)[100:] == [
        "plugin 'ROSInterface': nodes that use other types were reported 100 times; further ones are not reported"
    ]


def test_publisher_of_another_type_is_reported_once(roscore: RosCore, tmp_path: Path) -> None:
    with Probe(roscore.env) as probe:
        probe.ask("subscribe", "/speed", "float")
        node = (
            "p = rospy.Publisher('/speed', std_msgs.msg.String, queue_size=1, latch=True); p.publish('x'); rospy.spin()"
        )
        with rospy_node(roscore, node, tmp_path / "peer"):
            probe.wait_for(lambda: bool(reported(probe)), "the line")
            # A second publisher shows that two more checks have passed.
            with Probe(roscore.env, "__name:=second") as second:
                second.ask("advertise", "/speed", "other_float")
                probe.wait_for(lambda: len(reported(probe)) > 1, "the second publisher's line")
    assert reported(probe) == [
        f"plugin 'ROSInterface': topic '/speed': node /peer publishes {STRING}, but this node subscribes to "
        f"{FLOAT}, so no messages arrive from it; use the same type in both",
        f"plugin 'ROSInterface': topic '/speed': node /second publishes {OTHER_FLOAT}, but this node "
        f"subscribes to {FLOAT}, so no messages arrive from it; {REBUILD}",
    ]


def test_subscriber_with_another_version_of_the_type_is_advised_to_rebuild(roscore: RosCore) -> None:
    with Probe(roscore.env) as probe, Probe(roscore.env, "__name:=other") as other:
        probe.ask("advertise", "/speed", "float")
        other.ask("subscribe", "/speed", "other_float")
        probe.wait_for(lambda: bool(reported(probe)), "the line")
        assert reported(probe) == [
            f"plugin 'ROSInterface': topic '/speed': node /other subscribes to {OTHER_FLOAT}, but this node "
            f"publishes {FLOAT}, so no messages are sent to it; {REBUILD}"
        ]
        other.wait_for(lambda: bool(reported(other)), "the other's line")
        assert f"node /sim_ros_interface publishes {FLOAT}, but this node subscribes to" in reported(other)[0]


def test_client_of_another_service_type_is_reported_once(roscore: RosCore, tmp_path: Path) -> None:
    call = "rospy.ServiceProxy('/paint', std_srvs.srv.Trigger)()"
    code = f"for i in range(2):\n try: {call}\n except rospy.ServiceException: print('refused')"
    log = tmp_path / "peer"
    with Probe(roscore.env) as probe:
        probe.ask("serve", "/paint", "setbool")
        wait_until(lambda: "/paint" in roscore.state()["services"], "the service")
        with rospy_node(roscore, code, log):
            wait_until(lambda: log.read_text().count("refused") == 2, "both calls")
    assert reported(probe) == [
        "plugin 'ROSInterface': service '/paint': a client calls a type with md5 "
        "937c9679a518e3a18d831e57125ea522, but this node provides std_srvs/SetBool (md5 "
        "09fb03525b03e7ea1fd3992bafd87e16), so the call is refused; use the same type in both, built from the same "
        "definition"
    ]


def test_other_errors_of_roscpp_are_still_printed(roscore: RosCore) -> None:
    with Probe(roscore.env) as probe:
        probe.ask("serve", "/paint", "setbool", "fail")
        wait_until(lambda: "/paint" in roscore.state()["services"], "the service")
        subprocess.run(
            ["rosservice", "call", "/paint", "true"], env=roscore.env, capture_output=True, timeout=60, check=False
        )
        probe.wait_for(lambda: any("out of paint" in line for line in probe.errors), "roscpp's own line")
