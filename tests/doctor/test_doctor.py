# SPDX-License-Identifier: BSD-3-Clause
"""bubblesim doctor finds real problems and suggests what to do."""

import os
import signal
import socket
import subprocess
import xmlrpc.client
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from cli_support import bubblesim
from node_support import Node, write
from ros_support import RosCore, alone_on_port, free_port, ros_environment, start, wait_until


def finding(run: "subprocess.CompletedProcess[str]", words: str) -> tuple[str, str]:
    """Return level and suggestion of the finding with these words."""
    lines = run.stdout.splitlines()
    number = next((number for number, line in enumerate(lines) if words in line), None)
    assert number is not None, run.stdout + run.stderr
    return lines[number].split()[0], lines[number + 1].partition("fix: ")[2]


@pytest.fixture
def terminal(tmp_path: Path) -> dict[str, str]:
    """Return an environment without problems except the missing master."""
    return ros_environment(free_port(), tmp_path)


def test_a_healthy_machine_has_no_problem(roscore: RosCore) -> None:
    run = bubblesim("doctor", env=roscore.env)
    assert (run.returncode, "problem" in run.stdout) == (0, False), run.stdout
    assert "a ROS master answers" in run.stdout
    assert "scripts run, in Python and in Lua" in run.stdout


def test_a_missing_master_is_a_warning(terminal: dict[str, str]) -> None:
    run = bubblesim("doctor", "ros", env=terminal)
    assert run.returncode == 0
    assert finding(run, "no ROS master answers") == (
        "warning",
        "start roscore in another terminal, or use bubblesim run ... --roscore",
    )


@pytest.mark.parametrize("uri", ["localhost:11311", "http://localhost", "http://localhost:x", ""])
def test_an_address_that_is_none_is_a_problem(terminal: dict[str, str], uri: str) -> None:
    run = bubblesim("doctor", "ros", env=terminal, ROS_MASTER_URI=uri)
    assert run.returncode == 1
    assert finding(run, f"ROS_MASTER_URI={uri} must have the form") == (
        "problem",
        "export ROS_MASTER_URI=http://localhost:11311",
    )


def test_without_an_address_ros_uses_the_usual_one(terminal: dict[str, str]) -> None:
    """As on a machine with a package, where no setup.bash is sourced."""
    del terminal["ROS_MASTER_URI"]
    run = bubblesim("doctor", "ros", env=terminal)
    assert "must have the form" not in run.stdout
    assert "http://localhost:11311" in run.stdout


def test_a_port_that_something_else_has_is_a_problem(terminal: dict[str, str]) -> None:
    with socket.create_server(("localhost", 0)) as other:  # accepts connections, but never answers
        port = other.getsockname()[1]
        run = bubblesim("doctor", "ros", env=terminal, ROS_MASTER_URI=f"http://localhost:{port}")
    assert run.returncode == 1
    level, cure = finding(run, "is not a ROS master")
    assert (level, f"sport = :{port}" in cure) == ("problem", True)


def test_what_it_knows_nothing_about_is_reported() -> None:
    run = bubblesim("doctor", "weather")
    assert run.returncode == 2
    assert "unknown check 'weather'; the checks are build, messages, ros, ports" in run.stderr


def test_names_that_nobody_can_resolve_are_problems(terminal: dict[str, str]) -> None:
    run = bubblesim("doctor", "ros", env=terminal, ROS_HOSTNAME="robot.invalid")
    assert run.returncode == 1
    assert finding(run, "ROS_HOSTNAME=robot.invalid does not resolve") == ("problem", "export ROS_HOSTNAME=localhost")
    run = bubblesim("doctor", "ros", env=terminal, ROS_MASTER_URI="http://robot.invalid:11311")
    assert finding(run, "robot.invalid does not resolve")[0] == "problem"


def test_simulated_time_without_a_clock_is_a_problem(roscore: RosCore) -> None:
    roscore.set_param("/use_sim_time", True)
    run = bubblesim("doctor", "ros", env=roscore.env)
    assert run.returncode == 1
    level, cure = finding(run, "/use_sim_time is set, but no node publishes /clock")
    assert (level, cure.startswith("rosparam delete /use_sim_time")) == ("problem", True)


def test_a_node_that_was_killed_is_a_warning(roscore: RosCore) -> None:
    node = start(["rostopic", "pub", "/gone", "std_msgs/Bool", "true"], roscore.env, stdout=subprocess.DEVNULL)
    wait_until(lambda: "/gone" in roscore.state()["publishers"], "the node")
    os.killpg(node.pid, signal.SIGKILL)
    node.wait()
    run = bubblesim("doctor", "ros", env=roscore.env)
    assert run.returncode == 0
    assert finding(run, "nodes registered at the master do not respond: /rostopic") == ("warning", "rosnode cleanup")


def test_a_workspace_that_rosrun_does_not_know_is_a_problem(terminal: dict[str, str]) -> None:
    run = bubblesim("doctor", "build", env=terminal, ROS_PACKAGE_PATH="/nowhere")
    assert run.returncode == 1
    assert "setup.bash" in finding(run, "rosrun and roslaunch do not find bubblesim")[1]


def test_a_node_that_does_not_run_is_a_problem(terminal: dict[str, str], tmp_path: Path) -> None:
    (tmp_path / "ball.sdf").write_text("no scene")
    run = bubblesim("doctor", "build", env=terminal, BUBBLESIM_SCENE_PATH=str(tmp_path))
    assert run.returncode == 1
    assert finding(run, "does not run: exit code 2")[0] == "problem"


def test_a_missing_lua_is_a_warning(terminal: dict[str, str], tmp_path: Path) -> None:
    run = bubblesim("doctor", "build", env=terminal, VIRTUAL_ENV=str(tmp_path))
    assert finding(run, "scripts in Lua do not run") == (
        "warning",
        "pip install lupa==2.8 in the active virtual environment",
    )


def module(folder: Path, name: str, code: str) -> dict[str, str]:
    """Return an environment in which a module of the test comes first."""
    (folder / name).mkdir(parents=True)
    (folder / name / "__init__.py").write_text(code)
    return {"PYTHONPATH": f"{folder}:{os.environ['PYTHONPATH']}"}


def test_message_types_that_python_lacks_are_a_warning(terminal: dict[str, str], tmp_path: Path) -> None:
    run = bubblesim("doctor", "messages", env=terminal, **module(tmp_path, "trajectory_msgs", ""))
    level, cure = finding(run, "nodes in Python cannot use trajectory_msgs/JointTrajectory")
    assert (level, "apt-get install python3-trajectory-msgs" in cure) == ("warning", True)


def test_message_types_that_differ_are_a_problem(terminal: dict[str, str], tmp_path: Path) -> None:
    changes = module(tmp_path, "trajectory_msgs", "")
    code = "from genpy import Message\nclass JointTrajectory(Message):\n    _md5sum = 'other'\n"
    module(tmp_path / "trajectory_msgs", "msg", code)
    run = bubblesim("doctor", "messages", env=terminal, **changes)
    assert run.returncode == 1
    assert finding(run, "different definitions of trajectory_msgs/JointTrajectory")[0] == "problem"


@pytest.mark.parametrize("about", ["build", "messages"])
def test_a_numpy_that_bubblesim_is_not_built_for_is_a_problem(
    terminal: dict[str, str], tmp_path: Path, about: str
) -> None:
    built = int(np.__version__.partition(".")[0])  # the tests use the system's
    code = f"""\
import sys
sys.path.remove({str(tmp_path)!r})
del sys.modules["numpy"]
import numpy
numpy.__version__ = "{built + 1}.4.6"
"""
    run = bubblesim("doctor", about, env=terminal, **module(tmp_path, "numpy", code))
    assert run.returncode == 1
    words = f"bubblesim was built for numpy {built}.x, this Python has {built + 1}.4.6 in"
    level, cure = finding(run, words)
    assert (level, cure.endswith(f'-m pip install "numpy<{built + 1}"')) == ("problem", True)
    assert run.stderr == ""


def test_a_port_that_a_scene_serves_and_another_has_is_a_warning(terminal: dict[str, str]) -> None:
    with alone_on_port(5000):
        try:
            server = socket.create_server(("127.0.0.1", 5000))
        except OSError:
            server = None  # already in use
        run = bubblesim("doctor", "ports", env=terminal)
        if server:
            server.close()
    assert finding(run, "cannot bind port 5000, which the scene tricycle_socket needs")[0] == "warning"


def test_two_simulators_on_one_master_are_a_problem(roscore: RosCore, tmp_path: Path) -> None:
    with Node(roscore.env, tmp_path / "a", "ball") as first:
        first.wait_until_ready(roscore)
        with Node(roscore.env, tmp_path / "b", "ball", "__name:=other", "/clock:=/other/clock") as second:
            second.wait_until_ready(roscore, "/other")
            assert "simulators on /clock" not in bubblesim("doctor", "ros", env=roscore.env).stdout
            master: Any = xmlrpc.client.ServerProxy(roscore.env["ROS_MASTER_URI"])
            api = master.lookupNode("/test", "/other")[2]
            master.registerPublisher("/other", "/clock", "rosgraph_msgs/Clock", api)
            try:
                run = bubblesim("doctor", "ros", env=roscore.env)
            finally:
                master.unregisterPublisher("/other", "/clock", api)
            level, cure = finding(run, "the times of 2 simulators on /clock: /other, /sim_ros_interface")
            assert (level, run.returncode) == ("problem", 1)
            assert "bubblesim run SCENE --isolated" in cure


def test_another_python_of_the_terminal_is_named(tmp_path: Path, terminal: dict[str, str]) -> None:
    other = write(tmp_path / "python3", "#!/bin/sh\necho /opt/pyenv\n")
    other.chmod(0o755)
    run = bubblesim("doctor", "build", env=terminal, PATH=f"{tmp_path}:{terminal['PATH']}")
    level, cure = finding(run, f"the terminal's python3 is {other}, not Debian's")
    assert (level, cure.startswith("export PATH=/usr/bin:$PATH")) == ("warning", True)
