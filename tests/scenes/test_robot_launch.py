# SPDX-License-Identifier: BSD-3-Clause
"""The robots' launch files: all frames from map to the last wheel and sensor exist."""

import re
import signal
import subprocess
import sys
from pathlib import Path

import pytest

from bubblesim.running.launch_arguments import unknown_argument
from node_support import Node
from ros_support import DEADLINE, REPOSITORY, SUPPORT, RosCore, start, stop_launch, wait_until

# Heights of the frames from the robots' dimensions, metres.
FRAMES = {
    "pioneer": {
        "odom": 0.0,
        "base_link": 0.0,
        "Pioneer_p3dx_leftWheel": 0.0975,
        "Pioneer_p3dx_rightWheel": 0.0975,
        "Pioneer_p3dx_caster_link": 0.0375,
        "Pioneer_p3dx_caster_wheel": 0.0375,
        "Pioneer_p3dx_lidar": 0.31,
    },
    "tricycle": {
        "odom": 0.0,
        "base_link": 0.0,
        "fork": 0.3,
        "front_wheel": 0.3,
        "rear_left_wheel": 0.3,
        "rear_right_wheel": 0.3,
        "FrontSonar": 0.5,
        "Camera_optical": 0.9,
        "Gps": 0.93,
    },
    "bubblerob": {
        "odom": 0.0,
        "base_link": 0.0,
        "left_wheel": 0.04,
        "right_wheel": 0.04,
        "rosInterfaceControlledBubbleRobSensingNose": 0.12,
    },
}


@pytest.mark.parametrize("robot", FRAMES)
def test_all_frames_of_a_robot_hang_together(roscore: RosCore, tmp_path: Path, robot: str) -> None:
    launched = start(["roslaunch", "bubblesim", f"{robot}.launch"], roscore.env, stdout=subprocess.DEVNULL)
    try:
        probe = subprocess.run(
            [sys.executable, str(SUPPORT / "frames_probe.py"), "map", *FRAMES[robot]],
            env=roscore.env,
            stdout=subprocess.PIPE,
            text=True,
            timeout=3 * DEADLINE,
            check=True,
        )
    finally:
        stop_launch(launched)
    heights = {frame: float(z) for frame, _, _, z in (line.split() for line in probe.stdout.splitlines())}
    assert heights == pytest.approx(FRAMES[robot], abs=1e-3)


@pytest.mark.parametrize("before", [None, True, False])
def test_use_sim_time_is_put_back_at_the_end(roscore: RosCore, before: bool | None) -> None:
    if before is not None:
        roscore.set_param("/use_sim_time", before)
    launched = start(["roslaunch", "bubblesim", "bubblerob.launch"], roscore.env, stdout=subprocess.DEVNULL)
    try:
        wait_until(lambda: "/sim_ros_interface" in roscore.nodes(), "the simulator", 2 * DEADLINE)
        assert roscore.run("rosparam", "get", "/use_sim_time") == "true\n"
        launched.send_signal(signal.SIGINT)
        launched.wait(timeout=2 * DEADLINE)
    finally:
        stop_launch(launched)
    parameters = roscore.run("rosparam", "list").split()
    assert "/sim_ros_interface/use_sim_time_before" not in parameters
    if before is None:
        assert "/use_sim_time" not in parameters
    else:
        assert roscore.run("rosparam", "get", "/use_sim_time") == f"{str(before).lower()}\n"


def test_a_second_simulator_is_refused_before_its_nodes_replace_those_of_the_first(roscore: RosCore) -> None:
    launched = start(["roslaunch", "bubblesim", "bubblerob.launch"], roscore.env, stdout=subprocess.DEVNULL)
    try:
        helpers = {"/map_to_odom", "/robot_state_publisher"}
        wait_until(lambda: helpers < set(roscore.nodes()), "the other nodes", 2 * DEADLINE)
        wait_until(lambda: "/sim_ros_interface" in roscore.nodes(), "the simulator", 2 * DEADLINE)
        before = {name: roscore.pid_of(name) for name in helpers}
        second = subprocess.run(
            ["roslaunch", "bubblesim", "tricycle.launch"],
            env=roscore.env,
            capture_output=True,
            text=True,
            timeout=3 * DEADLINE,
            check=False,
        )
        assert second.returncode != 0
        assert "error: a simulator runs already as node /sim_ros_interface" in second.stderr
        assert {name: roscore.pid_of(name) for name in helpers} == before
    finally:
        stop_launch(launched)


def test_a_simulator_of_any_name_is_found_before_a_launch(roscore: RosCore, tmp_path: Path) -> None:
    with Node(roscore.env, tmp_path / "log", "ball", "__name:=mine") as node:
        node.wait_until_ready(roscore, "/mine")
        run = subprocess.run(
            ["rosrun", "bubblesim", "before_launch"],
            env=roscore.env,
            capture_output=True,
            text=True,
            timeout=2 * DEADLINE,
            check=False,
        )
    assert run.returncode == 1
    assert "error: a simulator runs already as node /mine at" in run.stderr
    assert "rosnode kill /mine" in run.stderr


@pytest.mark.parametrize(
    ("argument", "answer"),
    [
        ("control:=false", "error: tricycle.launch has no argument control; did you mean controller?"),
        ("scene:=ball", "error: tricycle.launch has no argument scene; it has controller, gazebo_compat, map_to_odom"),
    ],
)
def test_an_argument_with_a_typo_is_refused(roscore: RosCore, argument: str, answer: str) -> None:
    run = subprocess.run(
        ["roslaunch", "bubblesim", "tricycle.launch", argument],
        env=roscore.env,
        capture_output=True,
        text=True,
        timeout=3 * DEADLINE,
        check=False,
    )
    assert run.returncode != 0
    assert answer in run.stderr


@pytest.mark.parametrize("file", ["bubblerob", "pioneer", "pioneer_slam", "quadcopter", "tricycle", "tricycle_cmd_vel"])
def test_all_arguments_of_launch_files_are_known(file: str) -> None:
    launch = REPOSITORY / "launch"
    command = ["roslaunch", "--ros-args", launch / f"{file}.launch"]
    shown = subprocess.run(command, capture_output=True, text=True, timeout=DEADLINE, check=True)
    names = re.findall(r"^  (\w+)", shown.stdout, re.MULTILINE)
    assert "seed" in names
    assert unknown_argument(["bubblesim", f"{file}.launch", *(f"{name}:=1" for name in names)], launch) is None


def test_programs_that_were_not_built_are_named_with_the_cure() -> None:
    run = subprocess.run(
        ["rosrun", "bubblesim", "before_launch", "--needs", "mapper", "no_such_program"],
        capture_output=True,
        text=True,
        timeout=DEADLINE,
        check=False,
    )
    assert run.returncode == 1
    assert run.stderr == "error: not built: no_such_program; in a clone, run scripts/setup --with maps\n"
