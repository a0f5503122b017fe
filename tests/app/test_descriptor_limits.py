# SPDX-License-Identifier: BSD-3-Clause
"""A node that may open few files, or very many, serves its clients on each kind of port."""

import contextlib
import resource
import time
from collections.abc import Iterator
from pathlib import Path

import pytest

from every_port import PORTS, ListeningNode, cpu_seconds, most_open_files, reset, wait_for_descriptors
from node_support import Node, write
from ros_peer import Peer
from ros_support import RosCore, wait_until

FEW = 128
MOST = min(1_048_576, resource.getrlimit(resource.RLIMIT_NOFILE)[1])
"""What containers often allow, as far as this machine does."""
CYCLES = 200
BUSY = 0.4
"""Processor time a second of a server that tries to accept a connection again and again."""


@pytest.fixture
def node(roscore: RosCore, tmp_path: Path) -> Iterator[ListeningNode]:
    with ListeningNode(roscore, tmp_path, limit=FEW) as running:
        yield running
        assert running.process.poll() is None, running.output


@pytest.mark.parametrize("port", PORTS)
def test_clients_that_come_and_are_killed_leave_no_descriptors(node: ListeningNode, port: str) -> None:
    server = node.server(port)
    before = most_open_files(server)
    for _ in range(CYCLES):
        connection = node.connect(port)
        connection.sendall(b"\x01\x02")
        reset(connection)
    wait_for_descriptors(server, before + 2)
    node.ask(port)


@pytest.mark.parametrize("port", PORTS)
def test_more_clients_than_descriptors_keep_no_server_busy_and_no_other_port_from_answering(
    node: ListeningNode, port: str
) -> None:
    server = node.server(port)
    before = most_open_files(server)
    held = []
    with contextlib.suppress(TimeoutError):  # more than those wait to be accepted
        for _ in range(CYCLES):
            held.append(connection := node.connect(port, timeout=1.0))
            with contextlib.suppress(ConnectionError):
                connection.sendall(b"\x01\x02")
    used, begin = cpu_seconds(server), time.monotonic()
    time.sleep(2.0)
    assert (cpu_seconds(server) - used) / (time.monotonic() - begin) < BUSY
    for other in PORTS:
        if other != port:
            node.ask(other)
    for connection in held:
        reset(connection)
    wait_for_descriptors(server, before + 2)
    wait_until(lambda: node.is_answered(port), "an answer to the next client")


@pytest.mark.parametrize("limit", [1024, MOST])
def test_messages_come_whatever_the_limit_of_descriptors(roscore: RosCore, tmp_path: Path, limit: int) -> None:
    code = """
        def sysCall_init(): self.numbers = simROS.advertise('/numbers', 'std_msgs/Float32')
        def sysCall_sensing(): simROS.publish(self.numbers, {'data': 1.0})
    """
    script = write(tmp_path / "script.py", code)
    within = ("prlimit", f"--nofile={limit}")
    options = ("ball", "--child-script", f"/Ball={script}")
    with Node(roscore.env, tmp_path / "log", *options, within=within), Peer(roscore, tmp_path / "peer") as peer:
        assert peer.next("/numbers", "std_msgs/Float32")["data"] == 1.0
