# SPDX-License-Identifier: BSD-3-Clause
"""Whether a simulator runs at a master: one that was killed does not, although the master lists it."""

import os
import signal
from pathlib import Path

import pytest

from bubblesim.running.master import simulator_runs
from node_support import Node
from ros_support import RosCore


def test_a_stopped_simulator_holds_its_name_and_a_killed_one_does_not(
    roscore: RosCore, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("ROS_MASTER_URI", roscore.env["ROS_MASTER_URI"])
    assert not simulator_runs()
    with Node(roscore.env, tmp_path / "log", "ball") as node:
        node.wait_until_ready(roscore)
        assert simulator_runs()
        os.kill(node.process.pid, signal.SIGSTOP)
        try:
            assert simulator_runs()
        finally:
            os.kill(node.process.pid, signal.SIGCONT)
        node.end(signal.SIGKILL)
        assert not simulator_runs()
