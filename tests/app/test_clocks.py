# SPDX-License-Identifier: BSD-3-Clause
"""A wall clock that is set while the node runs, and a node that is stopped and continued."""

import os
import signal
import time
from pathlib import Path

import pytest
import rosbag

from every_port import ListeningNode
from node_support import NAME, Node, write
from ros_peer import Peer
from ros_support import DEADLINE, RosCore, wait_until

LIBRARY = Path("/usr/lib/x86_64-linux-gnu/faketime/libfaketimeMT.so.1")
HOUR = 3600
SLACK = 2.0
"""Seconds that a busy machine may take for the calls between two measurements."""


pytestmark = pytest.mark.skipif("LD_PRELOAD" in os.environ, reason="a sanitizer must be the first library to load")


class SetClock:
    """A wall clock of the programs in its environment, which a file sets."""

    def __init__(self, folder: Path) -> None:
        self._file = folder / "clock"
        self.set(0)
        self.env = {
            "LD_PRELOAD": str(LIBRARY),
            "FAKETIME_TIMESTAMP_FILE": str(self._file),
            "FAKETIME_NO_CACHE": "1",
            "FAKETIME_DONT_FAKE_MONOTONIC": "1",  # no program can set that one
        }

    def set(self, seconds: int) -> None:
        """Set it by so many seconds off the machine's."""
        new = self._file.with_suffix(".new")
        new.write_text(f"{seconds:+d}\n")
        new.replace(self._file)


def advance(node: ListeningNode, seconds: float) -> float:
    """Return how much simulated time passes in some seconds, which are as many on average."""
    begin = node.time()
    time.sleep(seconds)
    return node.time() - begin


@pytest.mark.parametrize("offset", [HOUR, -HOUR])
def test_a_clock_that_is_set_changes_neither_steps_nor_messages(roscore: RosCore, tmp_path: Path, offset: int) -> None:
    clock = SetClock(tmp_path)
    with ListeningNode(roscore, tmp_path, env=clock.env) as node, Peer(roscore, tmp_path / "peer.txt") as peer:
        peer.next("/clock", "rosgraph_msgs/Clock")
        clock.set(offset)
        for _ in range(3):  # once the clock is set, and later
            assert 0.1 < advance(node, 1.0) < 1.0 + SLACK
            peer.next("/clock", count=10)
        for port in node.ports:
            node.ask(port)
        begin = time.monotonic()
        assert node.end() == 0, node.output
        assert time.monotonic() - begin < 3 * SLACK
        assert "error" not in node.output


@pytest.mark.parametrize("offset", [HOUR, -HOUR])
def test_a_clock_that_is_set_costs_a_recording_no_message(roscore: RosCore, tmp_path: Path, offset: int) -> None:
    code = """
        def sysCall_init(): self.numbers = simROS.advertise('/numbers', 'std_msgs/Float32')
        def sysCall_sensing():
            simROS.publish(self.numbers, {'data': sim.getSimulationTime()})
            print('at', f'{sim.getSimulationTime():.2f}')
    """
    clock, bag, script = SetClock(tmp_path), tmp_path / "run.bag", write(tmp_path / "script.py", code)
    options = ("ball", "--record", bag, "--until", 4, "--child-script", f"/Ball={script}")
    with Node(roscore.env | clock.env, tmp_path / "log", *options) as node:
        node.wait_for_output("at 1.50")
        clock.set(offset)
        node.wait_for_output("at 2.50")
        clock.set(0)
        assert node.process.wait(DEADLINE) == 0, node.output
    with rosbag.Bag(str(bag)) as file:
        numbers = sorted(message.data for _, message, _ in file.read_messages(topics=["/numbers"]))
    assert numbers == pytest.approx([0.05 * n for n in range(80)], abs=1e-5)


@pytest.mark.parametrize("seconds", [3, pytest.param(30, marks=pytest.mark.long)])
def test_a_node_that_was_stopped_goes_on_without_making_up_for_it(
    roscore: RosCore, tmp_path: Path, seconds: int
) -> None:
    with ListeningNode(roscore, tmp_path) as node, Peer(roscore, tmp_path / "peer.txt") as peer:
        peer.next("/clock", "rosgraph_msgs/Clock")
        before, begin = node.time(), time.monotonic()
        os.kill(node.process.pid, signal.SIGSTOP)
        time.sleep(seconds)
        os.kill(node.process.pid, signal.SIGCONT)
        after = node.time()
        assert after - before < time.monotonic() - begin - seconds + 0.5
        peer.next("/clock", count=10)
        assert 0.1 < advance(node, 1.0) < 1.0 + SLACK
        for port in node.ports:
            node.ask(port)
        wait_until(lambda: NAME in roscore.nodes(), "the node to be listed")
