# SPDX-License-Identifier: BSD-3-Clause
"""Clients that send junk, never read, or are slow, on each kind of port: the others are served, the steps go on."""

import statistics
import time
from collections.abc import Iterator
from contextlib import suppress
from pathlib import Path

import pytest

from every_port import PORTS, ListeningNode, reset
from node_support import without_slowness
from ros_support import DEADLINE, RosCore
from rude_client import junk_sent_to

SLOW = 200
STEP = 0.05
"""Seconds of a simulation step, in which the child script answers: an answer may take one more by chance."""
LINES = 120  # ten errors of the window's server, with where they arose, and those of a peer
BEGUN = {
    "XML-RPC": b"POST /",
    "TCPROS": b"\x10\x00\x00\x00\x0c",
    "remote API": b"\xff\x00\x00\x00\x00",
    "window": b"GET / ",
    "script": b"0.25",
}
"""The first bytes of a request, which slow clients send one by one."""


@pytest.fixture
def node(roscore: RosCore, tmp_path: Path) -> Iterator[ListeningNode]:
    with ListeningNode(roscore, tmp_path) as running:
        yield running
        assert running.process.poll() is None, running.output
        assert len(without_slowness(running.output).splitlines()) < LINES, running.output


def answer_times(node: ListeningNode, port: str, count: int) -> list[float]:
    return sorted(node.ask(port) for _ in range(count))


@pytest.mark.parametrize("attacked", PORTS)
def test_others_are_answered_during_junk(node: ListeningNode, attacked: str) -> None:
    with junk_sent_to(node.ports[attacked]):
        for port in PORTS:
            assert answer_times(node, port, 20)[-1] < DEADLINE


@pytest.mark.long  # a machine with other work is no place to compare times
@pytest.mark.parametrize("attacked", PORTS)
def test_junk_delays_the_answers_to_others_at_most_twice(node: ListeningNode, attacked: str) -> None:
    count = 200
    before = {port: statistics.median(answer_times(node, port, count)) for port in PORTS}
    with junk_sent_to(node.ports[attacked]):
        for port in PORTS:
            assert statistics.median(answer_times(node, port, count)) < 2 * before[port] + STEP


def real_time_factor(node: ListeningNode, windows: int) -> float:
    """Return the best of some seconds: other programs of a busy machine do not slow down each of them."""
    factors = []
    for _ in range(windows):
        begin, simulated = time.monotonic(), node.time()
        time.sleep(1.0)
        factors.append((node.time() - simulated) / (time.monotonic() - begin))
    return max(factors)


@pytest.mark.parametrize("port", PORTS)
@pytest.mark.parametrize("least", [0.5, pytest.param(0.95, marks=pytest.mark.long)])
def test_slow_clients_and_those_that_never_read_do_not_slow_down_the_simulation(
    node: ListeningNode, port: str, least: float
) -> None:
    slow = []
    with suppress(TimeoutError):  # beyond the limit of the port some are not accepted
        for _ in range(SLOW):
            slow.append(connection := node.connect(port, timeout=2.0))
            connection.setblocking(False)
    for byte in BEGUN[port]:
        for connection in slow:
            with suppress(OSError):  # some ports close such connections
                connection.send(bytes([byte]))
    assert real_time_factor(node, windows=4) > least
    for other in PORTS:
        if other != port:
            assert node.ask(other) < DEADLINE
    for connection in slow:
        reset(connection)
