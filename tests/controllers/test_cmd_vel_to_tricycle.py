# SPDX-License-Identifier: BSD-3-Clause
"""The node that converts velocities to a tricycle's front wheel."""

import math
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path

import pytest

from ros_support import REPOSITORY, RosCore, start, stop, wait_until

NODE = [sys.executable, str(REPOSITORY / "scripts" / "cmd_vel_to_tricycle.py")]


@pytest.fixture
def node(roscore: RosCore) -> Iterator["subprocess.Popen[str]"]:
    process = start([*NODE, "_wheelbase:=2.0", "_wheel_radius:=0.5"], roscore.env)
    wait_until(lambda: "/cmd_vel" in roscore.state()["subscribers"], "the node to listen")
    yield process
    stop(process)


def listen(core: RosCore, topic: str, file: Path) -> "subprocess.Popen[str]":
    with file.open("w") as output:
        return start(["rostopic", "echo", "-p", topic], core.env, stdout=output)


def last(file: Path, column: str) -> float | None:
    lines = file.read_text().splitlines()
    if len(lines) < 2 or lines[-1].count(",") != lines[0].count(","):
        return None
    return float(dict(zip(lines[0].split(","), lines[-1].split(","), strict=True))[column])


def test_a_velocity_becomes_an_angle_and_a_speed_until_none_comes(
    node: "subprocess.Popen[str]", roscore: RosCore, tmp_path: Path
) -> None:
    files = {topic: tmp_path / topic for topic in ("steering", "speed", "odom")}
    listeners = [listen(roscore, f"/{topic}", file) for topic, file in files.items()]
    command = ["rostopic", "pub", "-r", "10", "/cmd_vel", "geometry_msgs/Twist", "[1.0, 0, 0]", "[0, 0, 0.5]"]
    driver = start(command, roscore.env)
    speed = math.sqrt(2.0) / 0.5  # the front wheel, 2 m ahead on a circle of radius 2 m, moves at sqrt(2) m/s
    wait_until(lambda: last(files["steering"], "field.data") == pytest.approx(math.pi / 4), "the angle")
    wait_until(lambda: last(files["speed"], "field.data") == pytest.approx(speed), "the speed")
    turning = "field.twist.twist.angular.z"
    wait_until(lambda: last(files["odom"], turning) == pytest.approx(0.5), "the odometry to turn")
    wait_until(lambda: (last(files["odom"], "field.pose.pose.position.y") or 0.0) > 0.1, "the odometry to move left")
    stop(driver)
    wait_until(lambda: last(files["speed"], "field.data") == 0.0, "the wheel to stop")
    for listener in listeners:
        stop(listener)


@pytest.mark.parametrize("argument", ["_wheelbase:=0", "_wheel_radius:=wide", "_max_steering:=3"])
def test_parameters_that_cannot_be_are_reported(roscore: RosCore, argument: str) -> None:
    run = subprocess.run([*NODE, argument], env=roscore.env, capture_output=True, text=True, timeout=60, check=False)
    assert run.returncode == 2
    assert "invalid parameter of" in run.stdout + run.stderr
    assert "Traceback" not in run.stderr
