# SPDX-License-Identifier: BSD-3-Clause
"""Who finds the node: by domain, range, peers, and in a network of two machines."""

import itertools
import os
import shutil
import subprocess
import time
from collections.abc import Iterator
from pathlib import Path

import pytest

from node_support import Node, write
from ros2_peer import Domain, Ros2Peer
from ros_support import wait_until

NODE = "/sim_ros2_interface"
FLOAT = "std_msgs/msg/Float32"
SCRIPT = """
    def sysCall_init():
        self.out = simROS2.createPublisher('/out', 'std_msgs/Float32')
        simROS2.createSubscription('/in', 'std_msgs/Float32', 'on_in')

    def on_in(message):
        print('received', message['data'], flush=True)

    def sysCall_sensing():
        simROS2.publish(self.out, {'data': sim.getSimulationTime()})
"""
UNSEEN = 3.0  # s in which a peer would have found the node: it is announced each second


def node_in(env: dict[str, str], folder: Path) -> Node:
    file = write(folder / "script.py", SCRIPT)
    return Node(env, folder / "log", "ball", "--ros=2", "--child-script", f"/Ball={file}")


@pytest.mark.parametrize(
    ("node", "peer"),
    [
        ({}, {"ROS_AUTOMATIC_DISCOVERY_RANGE": "LOCALHOST"}),
        ({}, {"ROS_LOCALHOST_ONLY": "1"}),
        ({"ROS_LOCALHOST_ONLY": "1"}, {}),
        ({"ROS_AUTOMATIC_DISCOVERY_RANGE": "SUBNET"}, {}),
        ({"ROS_AUTOMATIC_DISCOVERY_RANGE": "SUBNET"}, {"ROS_AUTOMATIC_DISCOVERY_RANGE": "SUBNET"}),
    ],
)
def test_nodes_of_a_machine_find_each_other_in_each_range(
    node: dict[str, str], peer: dict[str, str], ros2_domain: Domain, tmp_path: Path
) -> None:
    with (
        node_in(ros2_domain.env(**node), tmp_path) as running,
        Ros2Peer(ros2_domain, tmp_path / "peer.log", **peer) as other,
    ):
        assert other.next("/out", FLOAT).keys() == {"data"}
        other.publish("/in", FLOAT, {"data": 2.5})
        running.wait_for_output("received 2.5")


@pytest.mark.parametrize("env", [{"ROS_AUTOMATIC_DISCOVERY_RANGE": "OFF"}, {"ROS_DOMAIN_ID": "other"}])
def test_nodes_that_are_off_or_in_another_domain_are_not_found(
    env: dict[str, str], ros2_domain: Domain, ros2_peer: Ros2Peer, tmp_path: Path
) -> None:
    other = Domain()
    changed = {name: value.replace("other", str(other.number)) for name, value in env.items()}
    with node_in(ros2_domain.env() | changed, tmp_path) as node:
        node.wait_for_output("load succeeded")
        time.sleep(UNSEEN)
        assert NODE not in ros2_peer.graph()["nodes"]
    other.release()


def test_a_node_killed_at_any_time_is_found_again(ros2_domain: Domain, ros2_peer: Ros2Peer, tmp_path: Path) -> None:
    """Twenty phases of its start and its run: 0 to 1.9 s."""
    ros2_peer.received("/out", FLOAT)
    for phase in range(20):
        folder = tmp_path / str(phase)
        folder.mkdir()
        with node_in(ros2_domain.env(), folder) as node:
            time.sleep(0.1 * phase)
            node.process.kill()
            node.process.wait()
    folder = tmp_path / "last"
    folder.mkdir()
    with node_in(ros2_domain.env(), folder) as node:

        def arrives() -> bool:
            """The peer does not wait for this node: those that were killed subscribe until their leases end."""
            ros2_peer.publish("/in", FLOAT, {"data": 7.5})
            return "received 7.5" in node.output

        ros2_peer.next("/out", count=3)
        wait_until(arrives, "'received 7.5' in the output")


@pytest.fixture
def two_machines(ros2_domain: Domain) -> Iterator[tuple[list[str], list[str]]]:
    """Return commands that run a program on each of two machines of a network: namespaces that a cable connects."""
    if os.geteuid() != 0 or not shutil.which("ip"):
        pytest.skip("network namespaces need root and the program ip")
    names = [f"bubblesim{ros2_domain.number}{end}" for end in "ab"]
    commands = [
        *(f"netns add {name}" for name in names),
        f"link add {names[0]} type veth peer name {names[1]}",
        *(f"link set {name} netns {name}" for name in names),
        *(f"-n {name} addr add 10.77.0.{host}/24 dev {name}" for host, name in enumerate(names, start=1)),
        *(f"-n {name} link set {device} up" for name, device in itertools.product(names, ["lo"])),
        *(f"-n {name} link set {name} up" for name in names),
        *(f"-n {name} route add 224.0.0.0/4 dev {name}" for name in names),
    ]
    try:
        for command in commands:
            made = subprocess.run(["ip", *command.split()], capture_output=True, text=True, check=False)
            if made.returncode != 0:
                pytest.skip(f"no network namespaces here: ip {command}: {made.stderr.strip()}")
        yield tuple(["ip", "netns", "exec", name] for name in names)  # type: ignore[misc]
    finally:
        for name in names:
            subprocess.run(["ip", "netns", "del", name], capture_output=True, check=False)


@pytest.mark.parametrize("how", ["SUBNET", "peers"])
def test_two_machines_of_a_network(
    how: str, two_machines: tuple[list[str], list[str]], ros2_domain: Domain, tmp_path: Path
) -> None:
    here, there = two_machines
    node_env = {"SUBNET": {"ROS_AUTOMATIC_DISCOVERY_RANGE": "SUBNET"}, "peers": {"ROS_STATIC_PEERS": "10.77.0.2"}}[how]
    peer_env = {"SUBNET": {"ROS_AUTOMATIC_DISCOVERY_RANGE": "SUBNET"}, "peers": {"ROS_STATIC_PEERS": "10.77.0.1"}}[how]
    file = write(tmp_path / "script.py", SCRIPT)
    options = ["ball", "--ros=2", "--child-script", f"/Ball={file}"]
    with (
        Node(ros2_domain.env(**node_env), tmp_path / "log", *options, within=here) as node,
        Ros2Peer(ros2_domain, tmp_path / "peer.log", within=there, **peer_env) as peer,
    ):
        assert peer.next("/out", FLOAT).keys() == {"data"}
        peer.publish("/in", FLOAT, {"data": 2.5})
        node.wait_for_output("received 2.5")


def test_another_machine_does_not_find_a_node_of_this_machine_only(
    two_machines: tuple[list[str], list[str]], ros2_domain: Domain, tmp_path: Path
) -> None:
    here, there = two_machines
    file = write(tmp_path / "script.py", SCRIPT)
    options = ["ball", "--ros=2", "--child-script", f"/Ball={file}"]
    with (
        Node(ros2_domain.env(), tmp_path / "log", *options, within=here) as node,
        Ros2Peer(ros2_domain, tmp_path / "peer.log", within=there, ROS_AUTOMATIC_DISCOVERY_RANGE="SUBNET") as peer,
    ):
        node.wait_for_output("load succeeded")
        time.sleep(UNSEEN)
        assert NODE not in peer.graph()["nodes"]
