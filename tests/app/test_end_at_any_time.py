# SPDX-License-Identifier: BSD-3-Clause
"""A signal at any time of the node's start and run ends it in time and leaves nothing half done."""

import signal
import time
from pathlib import Path

import pytest
import rosbag

from node_support import Node, write
from ros_support import RosCore

LIMIT = 2.0  # s
SLACK = 5.0
"""Extra time for ending a process on a busy machine."""

SCRIPT = "def sysCall_init(): print('init')\ndef sysCall_cleanup(): print('cleanup')\n"


@pytest.mark.parametrize("number", [signal.SIGINT, signal.SIGTERM])
@pytest.mark.parametrize("phases", [5, pytest.param(50, marks=pytest.mark.long)])
def test_a_signal_at_any_time_ends_it(roscore: RosCore, tmp_path: Path, phases: int, number: signal.Signals) -> None:
    script = write(tmp_path / "script.py", SCRIPT)
    options = ["ball", "--child-script", f"/Ball={script}", "--record"]
    begin = time.monotonic()
    with Node(roscore.env, tmp_path / "first", *options, tmp_path / "first.bag") as node:
        node.wait_for_output("init\n")
        start = time.monotonic() - begin
    for phase in range(phases):
        bag = tmp_path / f"{phase}.bag"
        with Node(roscore.env, tmp_path / f"log{phase}", *options, bag) as node:
            time.sleep(1.5 * start * phase / phases)
            begin = time.monotonic()
            code = node.end(number)
            took = time.monotonic() - begin
        report = f"phase {phase} of {phases}, {start:.2f} s: {node.output}"
        # It ends when Python has started, which may take twice as long as at first.
        assert took < 2 * start + LIMIT + SLACK, report
        assert code in {0, -number}, report
        assert code == 0 or node.output == "", report  # it ends as other programs do before it has anything to end
        assert node.output.count("init\n") == node.output.count("cleanup"), report
        assert node.has_unregistered(roscore), report
        assert not list(tmp_path.glob("*.active")), report
        if bag.exists():
            with rosbag.Bag(str(bag)) as file:
                assert file.get_message_count() >= 0
