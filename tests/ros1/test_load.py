# SPDX-License-Identifier: BSD-3-Clause
"""Subscribers that stop, or connect and disconnect."""

import os
import signal
import socket
import struct
import time
import xmlrpc.client
from typing import Any

import pytest

from bridge_probe import Probe
from process_support import open_files, status
from ros_support import DEADLINE, RosCore, wait_until

NAME = "/sim_ros_interface"
MEGABYTE = 1_000_000
RATE = 50
QUEUE = 10
PART = QUEUE // 2
CYCLES = 200
MASTER_CONNECTIONS = 2  # roscpp may keep these open between calls; a leak would show CYCLES times


def resident_megabytes(probe: Probe) -> float:
    return status(probe.process.pid, "VmRSS") / 1000


def flood(probe: Probe, publisher: str, live: Probe, subscriber: str, count: int) -> None:
    """Publish one megabyte 50 times a second; in parts that fit into the queue, until each has reached a subscriber."""
    for left in range(count, 0, -PART):
        part = min(left, PART)
        wanted = len(live.messages(subscriber)) + part
        probe.ask("flood", publisher, MEGABYTE, part)
        live.wait_for(lambda wanted=wanted: len(live.messages(subscriber)) >= wanted, "all messages")


@pytest.mark.parametrize("seconds", [10, pytest.param(60, marks=pytest.mark.long)])
def test_stopped_subscriber_costs_its_queue_and_the_others_nothing(roscore: RosCore, seconds: int) -> None:
    with (
        Probe(roscore.env) as probe,
        Probe(roscore.env, "__name:=live") as live,
        Probe(roscore.env, "__name:=stuck") as stuck,
    ):
        publisher = probe.ask("advertise", "/big", "string", "-", QUEUE)
        subscriber = live.ask("subscribe", "/big", "string", "size")
        probe.wait_for(lambda: probe.ask("wants", publisher) == "yes", "the live subscriber to connect")
        wait_until(lambda: "/live" in roscore.state()["subscribers"].get("/big", []), "the live subscriber")
        flood(probe, publisher, live, subscriber, RATE)
        before = resident_megabytes(probe)

        late = stuck.ask("subscribe", "/big", "string", "size")
        sent = RATE
        end = time.monotonic() + DEADLINE
        while not stuck.messages(late):
            assert time.monotonic() < end, "the second subscriber did not connect"
            flood(probe, publisher, live, subscriber, 1)
            sent += 1
        os.kill(stuck.process.pid, signal.SIGSTOP)
        flood(probe, publisher, live, subscriber, seconds * RATE)
        assert len(live.messages(subscriber)) == sent + seconds * RATE
        os.kill(stuck.process.pid, signal.SIGCONT)
        # The queue, one message in progress, and the allocator.
        assert resident_megabytes(probe) - before < QUEUE + 10


def connect_as_subscriber(core: RosCore, topic: str) -> socket.socket:
    """Open a TCPROS connection up to the publisher's response."""
    master: Any = xmlrpc.client.ServerProxy(core.env["ROS_MASTER_URI"])
    node: Any = xmlrpc.client.ServerProxy(master.lookupNode("/test", NAME)[2])
    _, host, port = node.requestTopic("/test", topic, [["TCPROS"]])[2]
    fields = (f"topic={topic}", "callerid=/test", "md5sum=*", "type=*")
    header = b"".join(struct.pack("<I", len(field)) + field.encode() for field in fields)
    connection = socket.create_connection((host, port))
    connection.sendall(struct.pack("<I", len(header)) + header)
    assert connection.recv(4)
    return connection


def test_subscribers_that_come_and_die_leave_no_descriptors(roscore: RosCore) -> None:
    with Probe(roscore.env) as probe:
        publisher = probe.ask("advertise", "/big", "string", "-", QUEUE)
        wait_until(lambda: NAME in roscore.state()["publishers"].get("/big", []), "the publisher")
        connect_as_subscriber(roscore, "/big").close()
        probe.wait_for(lambda: probe.ask("wants", publisher) == "no", "the first to be gone")
        baseline = open_files(probe.process.pid)
        for _ in range(CYCLES):
            connection = connect_as_subscriber(roscore, "/big")
            probe.ask("flood", publisher, MEGABYTE, 1)
            # The kernel resets the connection of a killed process with unread data.
            connection.setsockopt(socket.SOL_SOCKET, socket.SO_LINGER, struct.pack("ii", 1, 0))
            connection.close()
        # roscpp handles 200 closed connections one by one, which takes a while on a busy machine.
        probe.wait_for(lambda: probe.ask("wants", publisher) == "no", "the last to be gone", timeout=60.0)
        wait_until(
            lambda: open_files(probe.process.pid) <= baseline + MASTER_CONNECTIONS,
            "the descriptors to be closed",
            timeout=60.0,
        )
