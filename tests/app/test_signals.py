# SPDX-License-Identifier: BSD-3-Clause
"""Scripts that do not return cannot keep the node from ending in time."""

import re
import signal
import sys
import time
from pathlib import Path

import pytest

from node_support import Node, clean_environment, processes_with, run_sim, write
from ros_support import RosCore, wait_until

LIMIT = 2.0
SLACK = 5.0
"""Extra time for ending a process on a busy machine."""

LIMIT_WITH_MASTER = 0.7  # s, less than the node's


@pytest.mark.parametrize("number", [signal.SIGINT, signal.SIGTERM])
@pytest.mark.parametrize("hook", ["sysCall_init", "sysCall_actuation", "sysCall_sensing"])
@pytest.mark.parametrize("busy", ["time.sleep(60)", "while True: pass"], ids=["sleeping", "looping"])
def test_a_script_that_does_not_return_is_broken_off(
    roscore: RosCore, tmp_path: Path, busy: str, hook: str, number: signal.Signals
) -> None:
    code = f"""
        import time
        def sysCall_init(): simROS.advertise('/out', 'std_msgs/Empty')
        def sysCall_cleanup(): print('cleanup')
        def {hook}():
            print('begun')
            {busy}
    """
    script = write(tmp_path / "script.py", code)
    with Node(roscore.env, tmp_path / "log", "ball", "--child-script", f"/Ball={script}") as node:
        node.wait_for_output("begun")
        node.wait_until_listed(roscore)
        begin = time.monotonic()
        assert node.end(number) == 0
        assert time.monotonic() - begin < LIMIT + SLACK
        assert f"warning: child script of /Ball was interrupted in {hook} ({script}:" in node.output
        assert node.output.endswith("cleanup\n")
        assert node.has_unregistered(roscore)


def test_a_node_that_waits_for_a_controller_ends(roscore: RosCore, tmp_path: Path) -> None:
    with Node(roscore.env, tmp_path / "log", "tricycle", "--lockstep", "/speed") as node:
        wait_until(lambda: "/speed" in roscore.state()["subscribers"], "the tricycle to wait for the controller")
        begin = time.monotonic()
        assert node.end() == 0
        assert time.monotonic() - begin < LIMIT + SLACK


def test_a_script_that_python_cannot_break_off_is_left_behind(roscore: RosCore, tmp_path: Path) -> None:
    code = """
        import itertools
        def sysCall_init():
            sim.launchExecutable('bash', '-c "sleep 36058.5 & wait"')
            print('begun')
            sum(itertools.repeat(0))  # endless, in C
    """
    script = write(tmp_path / "script.py", code)
    with Node(roscore.env, tmp_path / "log", "ball", "--child-script", f"/Ball={script}") as node:
        node.wait_for_output("begun")
        node.wait_until_listed(roscore)
        begin = time.monotonic()
        assert node.end(signal.SIGTERM) == -signal.SIGTERM
        assert time.monotonic() - begin < LIMIT + SLACK
        assert "error: a script does not return" in node.output
        assert node.has_unregistered(roscore, blocked=1.25)
        wait_until(lambda: processes_with("sleep 36058.5") == [], "the end of what the script has started")


@pytest.mark.parametrize("number", [signal.SIGINT, signal.SIGTERM])
def test_a_master_that_hangs_does_not_keep_a_node_that_starts(
    roscore: RosCore, tmp_path: Path, number: signal.Signals
) -> None:
    roscore.pause()
    start = time.monotonic()
    with Node(roscore.env, tmp_path / "log", "ball") as node:
        wait_until(lambda: handles(node, number), "the node to wait for the master")
        begin = time.monotonic()
        assert node.end(number) == 0
        assert time.monotonic() - begin < LIMIT + SLACK
        # It goes on without a master after a while, which may have passed before the signal on a busy machine.
        assert "load" not in node.output or begin - start > LIMIT_WITH_MASTER


@pytest.mark.parametrize("number", [signal.SIGINT, signal.SIGTERM])
def test_a_scene_that_is_being_loaded_is_given_up(tmp_path: Path, number: signal.Signals) -> None:
    models = "".join(f'<model name="m{i}"><static>1</static><link name="link"/></model>' for i in range(100_000))
    scene = tmp_path / "long.sdf"
    scene.write_text(f'<sdf version="1.9"><world name="long">{models}</world></sdf>')
    with Node(clean_environment(), tmp_path / "log", scene, "--no-ros") as node:
        begin = time.monotonic()
        assert node.end(number) == -number
        assert time.monotonic() - begin < LIMIT + SLACK


def test_a_slow_start_of_python_is_no_script_that_does_not_return(tmp_path: Path) -> None:
    environment = tmp_path / "environment"
    version = f"python{sys.version_info.major}.{sys.version_info.minor}"
    packages = environment / "lib" / version / "site-packages"
    packages.mkdir(parents=True)
    begun = tmp_path / "begun"
    (packages / "slow.pth").write_text(f"import time; open('{begun}', 'w'); time.sleep({LIMIT + 0.5})\n")
    with Node(clean_environment(VIRTUAL_ENV=str(environment)), tmp_path / "log", "ball", "--no-ros") as node:
        wait_until(begun.exists, "Python to start")
        assert node.end() == 0
        assert node.output == ""


def test_a_second_ctrl_c_while_python_ends_changes_nothing(tmp_path: Path) -> None:
    code = """
        import builtins, os, signal
        class Last:
            def __del__(self, kill=os.kill, node=os.getpid(), number=signal.SIGINT, write=os.write):
                write(1, b'deleted\\n')
                kill(node, number)
        def sysCall_init():
            builtins.last = Last()  # Python deletes it when it no longer handles signals
            print('begun')
    """
    script = write(tmp_path / "script.py", code)
    with Node(clean_environment(), tmp_path / "log", "ball", "--no-ros", "--child-script", f"/Ball={script}") as node:
        node.wait_for_output("begun")
        assert node.end() == 0
        assert node.output.endswith("deleted\n")


@pytest.mark.parametrize("number", [signal.SIGINT, signal.SIGTERM])
def test_a_node_of_rospy_in_a_script_leaves_it_the_signals(
    roscore: RosCore, tmp_path: Path, number: signal.Signals
) -> None:
    code = """
        import rospy
        def sysCall_init():
            rospy.init_node('mine')
            print('begun')
        def sysCall_cleanup(): print('cleanup')
    """
    script = write(tmp_path / "script.py", code)
    with Node(roscore.env, tmp_path / "log", "ball", "--child-script", f"/Ball={script}") as node:
        node.wait_for_output("begun")
        assert "/mine" in roscore.nodes()
        node.wait_until_ready(roscore)
        begin = time.monotonic()
        assert node.end(number) == 0
        assert time.monotonic() - begin < LIMIT + SLACK
        assert node.output.count("warning: the handler of ") == 1, node.output  # rospy sets two
        assert "SIGTERM that rospy.core sets is ignored, because the simulator handles this signal" in node.output
        assert node.output.endswith("cleanup\n")


def test_a_handler_of_a_script_is_ignored_and_others_are_set(tmp_path: Path) -> None:
    code = """
        import os, signal
        def sysCall_init():
            for number in (signal.SIGINT, signal.SIGHUP, signal.SIGURG, signal.SIGUSR1):
                signal.signal(number, lambda number, frame: print('handled', number))
            os.kill(os.getpid(), signal.SIGUSR1)
            os.kill(os.getpid(), signal.SIGINT)
    """
    script = write(tmp_path / "script.py", code)
    run = run_sim("ball", "--no-ros", "--child-script", f"/Ball={script}")
    assert (run.returncode, run.stdout) == (0, f"handled {int(signal.SIGUSR1)}\n"), run.stderr
    assert "warning: the handler of SIGINT that child_script_Ball sets is ignored" in run.stderr


def handles(node: Node, number: signal.Signals) -> bool:
    """Return whether the node has a handler for the signal, which it sets when its scene is loaded."""
    status = Path(f"/proc/{node.process.pid}/status").read_text()
    caught = re.search(r"SigCgt:\s+(\w+)", status)
    assert caught
    return bool(int(caught[1], 16) & 1 << (number - 1))


def test_the_last_signal_is_left_to_valgrind(tmp_path: Path) -> None:
    """It refuses a handler for it, and Python would not start."""
    code = """
        def sysCall_init():
            status = open('/proc/self/status').read()
            caught = int(status.split('SigCgt:')[1].split()[0], 16)
            print(caught >> 62, 'of the last two')
            sim.quitSimulator()
    """
    script = write(tmp_path / "script.py", code)
    run = run_sim("ball", "--no-ros", "--child-script", f"/Ball={script}")
    assert run.stdout == "1 of the last two\n", run.stderr
