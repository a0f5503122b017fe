# SPDX-License-Identifier: BSD-3-Clause
"""Robots that others have published, started by their own launch files: their topics, and how they move."""

import json
import subprocess
import time
from pathlib import Path
from typing import Any

import pytest

from launch_support import ROBOTS, launched, with_packages
from node_support import write
from ros_support import DEADLINE, SUPPORT, RosCore, wait_until
from service_caller import ServiceCaller

pytestmark = pytest.mark.skipif(ROBOTS is None, reason="the robots of others are not there")

# Packages of sensors that the robots do not carry, whose files their descriptions include all the same.
NOT_MOUNTED = {
    "fath_pivot_mount_description": ["lockmount.urdf.xacro"],
    "flir_camera_description": ["flir_blackflys.urdf.xacro"],
    "realsense2_description": ["_d435.urdf.xacro"],
    "velodyne_description": ["VLP-16.urdf.xacro", "HDL-32E.urdf.xacro"],
}
EMPTY = '<robot xmlns:xacro="http://www.ros.org/wiki/xacro"/>'
SPEED = {"BUBBLESIM_GAZEBO_OPTIONS": "--speed 3 --seed 1"}


def environment(core: RosCore, folder: Path, **more: str) -> dict[str, str]:
    assert ROBOTS is not None
    for package, files in NOT_MOUNTED.items():
        (folder / package / "urdf").mkdir(parents=True)
        write(folder / package / "package.xml", f"<package><name>{package}</name></package>")
        for name in files:
            write(folder / package / "urdf" / name, EMPTY)
    return with_packages(core.env, ROBOTS, folder, **SPEED, **more)


def topic(core: RosCore, name: str) -> str:
    """Return one message as text."""
    return core.run("rostopic", "echo", "-n", "1", name)


def drive(env: dict[str, str], *arguments: object) -> dict[str, Any]:
    run = subprocess.run(
        ["/usr/bin/python3", str(SUPPORT / "drive_robot.py"), *map(str, arguments)],
        env=env,
        capture_output=True,
        text=True,
        timeout=6 * DEADLINE,
        check=False,
    )
    assert run.returncode == 0, run.stderr
    result: dict[str, Any] = json.loads(run.stdout.splitlines()[-1])
    return result


def speed_of(call: ServiceCaller) -> float:
    """Return simulated seconds per second."""
    begin, wall = call("/gazebo/get_world_properties")["sim_time"], time.monotonic()
    time.sleep(3.0)
    end = call("/gazebo/get_world_properties")["sim_time"]
    return float((end - begin) / (time.monotonic() - wall))


@pytest.mark.parametrize(
    ("launch", "model", "commands", "odometry", "speeds", "topics"),
    [
        pytest.param(
            ["turtlebot3_gazebo", "turtlebot3_empty_world.launch"],
            "turtlebot3_burger",
            "/cmd_vel",
            "/odom",
            (0.2, 0.8),
            ["/imu", "/scan", "/joint_states", "/odom", "/tf"],
            id="turtlebot3",
        ),
        pytest.param(
            ["jackal_gazebo", "empty_world.launch", "config:=front_laser", "joystick:=false", "gui:=false"],
            "jackal",
            "/cmd_vel",
            "/odometry/filtered",
            (0.5, 0.8),
            ["/imu/data", "/front/scan", "/joint_states", "/jackal_velocity_controller/odom", "/navsat/fix", "/tf"],
            id="jackal",
        ),
        pytest.param(
            ["husky_gazebo", "empty_world.launch"],
            "husky",
            "/cmd_vel",
            "/odometry/filtered",
            (0.5, 0.8),
            ["/imu/data", "/joint_states", "/husky_velocity_controller/odom", "/navsat/fix", "/tf"],
            id="husky",
        ),
    ],
)
def test_mobile_robots_drive_and_turn_as_their_odometry_reports(
    tmp_path: Path,
    launch: list[str],
    model: str,
    commands: str,
    odometry: str,
    speeds: tuple[float, float],
    topics: list[str],
) -> None:
    with RosCore(tmp_path / "roslog") as core:
        env = environment(core, tmp_path / "packages", TURTLEBOT3_MODEL="burger")
        with (
            launched(core, env, tmp_path / "log", *launch, ready="/gazebo/link_states"),
            ServiceCaller(core) as call,
        ):
            wait_until(lambda: model in call("/gazebo/get_world_properties")["model_names"], "the robot", 3 * DEADLINE)
            wait_until(lambda: odometry in core.state()["publishers"], "its odometry", 3 * DEADLINE)
            for name in topics:
                assert "nan" not in topic(core, name), name
            moved = drive(env, model, commands, odometry, *speeds)
        for reported, true in (moved["distances"], moved["angles"]):
            assert reported == pytest.approx(true, rel=0.03), moved
        assert moved["distances"][1] >= 1.9
