# SPDX-License-Identifier: BSD-3-Clause
"""The node among other ROS nodes: pausing, ending, and running without a master."""

import os
import pty
import signal
import subprocess
from pathlib import Path

import pytest

from node_support import NAME, Node, endless_fall, processes_with, run_sim, write
from ros_support import DEADLINE, RosCore, built, free_port, ros_environment, wait_until

REPORT = "def sysCall_init(): print('init')\ndef sysCall_cleanup(): print('cleanup')\n"


@pytest.mark.parametrize("number", [signal.SIGINT, signal.SIGTERM, signal.SIGHUP])
def test_signals_end_it_cleanly(roscore: RosCore, tmp_path: Path, number: signal.Signals) -> None:
    script = write(tmp_path / "script.py", REPORT)
    with Node(roscore.env, tmp_path / "log", "ball", "--child-script", f"/Ball={script}") as node:
        node.wait_until_listed(roscore)
        node.wait_for_output("init\n")
        assert node.end(number) == 0
        assert node.output.endswith("cleanup\n")
        assert node.has_unregistered(roscore)


def test_a_terminal_that_is_closed_ends_it_with_its_children(roscore: RosCore, tmp_path: Path) -> None:
    code = f"""
        def sysCall_init(): sim.launchExecutable('sleep', '36059.5')
        def sysCall_actuation(): print('running')
        def sysCall_cleanup(): open('{tmp_path}/cleanup', 'w').close()
    """
    script = write(tmp_path / "script.py", code)
    ours, its = pty.openpty()
    node = subprocess.Popen(
        ["setsid", "--ctty", "--wait", built("sim"), "ball", "--child-script", f"/Ball={script}"],
        env=roscore.env,
        stdin=its,
        stdout=its,
        stderr=its,
    )
    os.close(its)
    wait_until(lambda: NAME in roscore.nodes() and processes_with("sleep 36059.5") != [], "the script")
    os.close(ours)
    node.wait(timeout=DEADLINE)
    wait_until(lambda: processes_with("sleep 36059.5") == [], "the end of what the script has started")
    assert (tmp_path / "cleanup").exists()
    assert NAME not in roscore.nodes()


def test_a_terminal_that_is_closed_does_not_end_it_under_nohup(roscore: RosCore, tmp_path: Path) -> None:
    log = tmp_path / "log"
    with log.open("w") as output:
        node = subprocess.Popen(["nohup", built("sim"), "ball"], env=roscore.env, stdout=output, stderr=output)
    wait_until(lambda: NAME in roscore.nodes(), "the node")
    node.send_signal(signal.SIGHUP)
    assert roscore.echo("/simulationTime", count=3).count("data:") == 3
    node.send_signal(signal.SIGINT)
    assert node.wait(timeout=DEADLINE) == 0


@pytest.mark.parametrize("options", [["--paused"], ["--speed", "0.0001"]], ids=["paused", "slow"])
def test_signals_end_it_while_it_waits(roscore: RosCore, tmp_path: Path, options: list[str]) -> None:
    with Node(roscore.env, tmp_path / "log", "ball", *options) as node:
        node.wait_until_ready(roscore)
        assert node.end() == 0


def test_services_pause_and_resume_it(roscore: RosCore, tmp_path: Path) -> None:
    script = write(tmp_path / "script.py", REPORT)
    options = ["--paused", "--until", 0.5, "--child-script", f"/Ball={script}"]
    with Node(roscore.env, tmp_path / "log", "ball", *options) as node:
        wait_until(lambda: f"{NAME}/unpause" in roscore.state()["services"], "the service")
        assert "init\n" not in node.output
        roscore.run("rosservice", "call", f"{NAME}/unpause")
        assert node.process.wait(timeout=DEADLINE) == 0
        assert node.output.endswith("init\ncleanup\n")


def test_without_a_master_it_reports_that_and_runs_on(tmp_path: Path) -> None:
    port = free_port()
    script = write(tmp_path / "script.py", REPORT)
    options = ["--until", 0.5, "--child-script", f"/Ball={script}"]
    with Node(ros_environment(port, tmp_path), tmp_path / "log", "ball", *options) as node:
        assert node.process.wait(timeout=DEADLINE) == 0
        assert "plugin 'ROSInterface': load failed (failed initialization)" in node.output
        assert f"http://localhost:{port}" in node.output
        assert "roscore" in node.output
        assert node.output.endswith("\ninit\ncleanup\n")


def test_topics_appear_when_a_master_comes_late(tmp_path: Path) -> None:
    port = free_port()
    with Node(ros_environment(port, tmp_path), tmp_path / "log", "ball") as node:
        node.wait_for_output("load failed")
        with RosCore(tmp_path / "roslog", port) as core:
            wait_until(lambda: NAME in core.state()["publishers"].get("/simulationTime", []), "the topic")
            assert "data:" in core.echo("/simulationTime")
            assert node.end() == 0


def test_remappings_are_taken(roscore: RosCore, tmp_path: Path) -> None:
    options = ["ball", "__name:=robot", "/simulationTime:=/other/time"]
    with Node(roscore.env, tmp_path / "log", *options):
        wait_until(lambda: "/robot" in roscore.state()["publishers"].get("/other/time", []), "the remapped topic")


def test_diverging_physics_pause_the_node(roscore: RosCore, tmp_path: Path) -> None:
    code = """
        def sysCall_init(): simROS.subscribe('/received', 'std_msgs/Empty', lambda message: None)
    """
    options = ["--paused", "--child-script", f"/Ball={write(tmp_path / 'script.py', code)}"]
    with Node(roscore.env, tmp_path / "log", endless_fall(tmp_path), *options) as node:
        wait_until(lambda: f"{NAME}/unpause" in roscore.state()["services"], "the service")
        roscore.run("rosservice", "call", f"{NAME}/unpause")
        node.wait_for_output("paused until reset or stopped")
        assert node.process.poll() is None
        assert NAME in roscore.nodes()


def test_numpy_changes_no_variable_while_threads_of_ros_run(tmp_path: Path) -> None:
    """It sets these while it is imported and removes those that nobody else has set."""
    code = """
        import os
        def sysCall_init(): print('set:', *(os.environ.get(f'{blas}_MAIN_FREE') for blas in ('OPENBLAS', 'GOTOBLAS')))
    """
    script = write(tmp_path / "script.py", code)
    run = run_sim("ball", "--no-ros", "--until", "0.1", "--child-script", f"/Ball={script}")
    assert "set: 1 1" in run.stdout
