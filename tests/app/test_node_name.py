# SPDX-License-Identifier: BSD-3-Clause
"""The node's name on the master: conflicts with other nodes."""

import os
import signal
import subprocess
import time
from collections.abc import Iterator
from pathlib import Path

import pytest

from node_support import NAME, Node, run_sim, write
from ros_support import DEADLINE, RosCore, free_port, ros_environment, wait_until

STUCK = """
    import time
    def sysCall_init(): pass
    def sysCall_actuation():
        print('begun')
        time.sleep(60)
"""


@pytest.fixture
def first(roscore: RosCore, tmp_path: Path) -> Iterator[Node]:
    with Node(roscore.env, tmp_path / "first", "ball") as node:
        node.wait_until_ready(roscore)
        yield node


def run_second(core: RosCore, *options: str) -> "subprocess.CompletedProcess[str]":
    """Run another node, and again if a busy master answered so late that it ran without ROS."""
    while True:
        run = run_sim("ball", "--until", "0.5", *options, env=core.env)
        if "load failed" not in run.stderr:
            return run


def test_rosnode_kill_ends_the_process(roscore: RosCore, tmp_path: Path) -> None:
    script = write(
        tmp_path / "script.py", "def sysCall_init(): print('init')\ndef sysCall_cleanup(): print('cleanup')\n"
    )
    with Node(roscore.env, tmp_path / "log", "ball", "--child-script", f"/Ball={script}") as node:
        node.wait_until_listed(roscore)
        node.wait_for_output("init\n")
        assert "killed" in roscore.run("rosnode", "kill", NAME)
        assert node.process.wait(timeout=DEADLINE) == 0
        assert "info: shutdown requested: /rosnode" in node.output
        assert node.output.endswith("cleanup\n")
        assert NAME not in roscore.nodes()


def test_rosnode_kill_ends_a_process_whose_script_does_not_return(roscore: RosCore, tmp_path: Path) -> None:
    script = write(tmp_path / "script.py", STUCK)
    with Node(roscore.env, tmp_path / "log", "ball", "--child-script", f"/Ball={script}") as node:
        node.wait_for_output("begun")
        node.wait_until_listed(roscore)
        roscore.run("rosnode", "kill", NAME)
        assert node.process.wait(timeout=DEADLINE) == 0


def test_a_second_node_of_the_name_is_refused_in_one_line_and_the_first_goes_on(roscore: RosCore, first: Node) -> None:
    second = run_second(roscore)
    assert second.returncode == 2
    assert second.stderr.splitlines() == [
        f"error: a node {NAME} is already running on the ROS master {roscore.env['ROS_MASTER_URI']}: shut it down "
        "with --replace, or run beside it, with a master of its own: bubblesim run SCENE --isolated"
    ]
    assert roscore.echo("/simulationTime", count=3).count("data:") == 3
    assert first.process.poll() is None


def test_a_second_node_of_another_name_runs_beside_it(roscore: RosCore, first: Node, tmp_path: Path) -> None:
    topics = ["/clock:=/other/clock", "/tf:=/other/tf"]
    with Node(roscore.env, tmp_path / "second", "ball", "__name:=other", *topics) as second:
        second.wait_until_ready(roscore, "/other")
        assert second.end() == 0
    assert first.process.poll() is None


def test_a_second_simulator_does_not_publish_another_time(roscore: RosCore, first: Node) -> None:
    second = run_second(roscore, "__name:=other")
    assert second.returncode == 2
    (line,) = second.stderr.splitlines()
    assert line.startswith(f"error: {NAME} publishes /clock on the ROS master {roscore.env['ROS_MASTER_URI']}")
    assert "/clock:=/other/clock /tf:=/other/tf" in line
    assert roscore.state()["publishers"]["/clock"] == [NAME]
    assert first.process.poll() is None


def test_a_node_that_passes_the_time_on_is_no_second_simulator(roscore: RosCore, tmp_path: Path) -> None:
    with roscore.publishing("/clock", "rosgraph_msgs/Clock", "{clock: {secs: 1}}"):
        wait_until(lambda: "/clock" in roscore.state()["publishers"], "the publisher")
        assert run_sim("ball", "--until", "0.2", env=roscore.env).returncode == 0


def test_replace_ends_the_first(roscore: RosCore, first: Node, tmp_path: Path) -> None:
    with Node(roscore.env, tmp_path / "second", "ball", "--replace") as second:
        assert first.process.wait(timeout=DEADLINE) == 0
        second.wait_until_listed(roscore)
        assert "info: shutdown requested: /sim_ros_interface: another node takes this name" in first.output
        assert roscore.echo("/simulationTime", count=3).count("data:") == 3


def test_a_node_that_was_killed_leaves_its_name_free(roscore: RosCore, first: Node, tmp_path: Path) -> None:
    assert first.end(signal.SIGKILL) == -signal.SIGKILL
    assert NAME in roscore.nodes(), "the master does not know that it is gone"
    assert run_sim("ball", "--until", "0.2", env=roscore.env).returncode == 0


def test_a_node_that_hangs_is_not_ended_by_the_master_for_another(roscore: RosCore, first: Node) -> None:
    first.process.send_signal(signal.SIGSTOP)
    try:
        assert run_second(roscore).returncode == 2
    finally:
        first.process.send_signal(signal.SIGCONT)
    assert roscore.echo("/simulationTime", count=3).count("data:") == 3


def test_a_node_that_finds_its_name_taken_later_runs_on_without_ros_until_it_is_free(tmp_path: Path) -> None:
    env = ros_environment(free_port(), tmp_path)
    with Node(env, tmp_path / "early", "ball") as early:
        early.wait_for_output("load failed")
        os.kill(early.process.pid, signal.SIGSTOP)
        with RosCore(tmp_path / "roslog", int(env["ROS_MASTER_URI"].rpartition(":")[2])) as core:
            with Node(core.env, tmp_path / "late", "ball") as late:
                late.wait_until_ready(core)
                os.kill(early.process.pid, signal.SIGCONT)
                early.wait_for_output(f"not registered: a node {NAME} is already running")
                time.sleep(0.6)  # it checks again
                assert late.process.poll() is None
                assert early.output.count("is already running") == 1
                assert late.end() == 0
            early.wait_until_ready(core)
            assert early.end() == 0
