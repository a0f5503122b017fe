# SPDX-License-Identifier: BSD-3-Clause
"""The demo as a user runs it after the setup."""

import itertools
import os
import re
import signal
import subprocess
from pathlib import Path

import pytest

from ros_support import RosCore, built, free_port, ros_environment, start, stop, wait_until


def demo(folder: Path, port: int, *arguments: str) -> "subprocess.Popen[str]":
    return start(
        [str(built("bubblesim")), "demo", *arguments],
        ros_environment(port, folder / "roslog"),
        cwd=folder,
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
    )


def processes_with(text: str) -> list[str]:
    """Return the command lines of running processes with the text in their environment."""
    found = []
    for folder in Path("/proc").glob("[0-9]*"):
        try:
            if int(folder.name) != os.getpid() and text in (folder / "environ").read_text(errors="replace"):
                found.append((folder / "cmdline").read_text(errors="replace").replace("\0", " "))
        except OSError:
            continue
    return found


def until_it_drives(process: "subprocess.Popen[str]") -> str:
    """Return the output up to a line with another pose than the first; a busy machine starts controllers slowly."""
    output, poses = "", set()
    assert process.stdout is not None
    for line in itertools.islice(process.stdout, 100):  # one in 2 s
        output += line
        poses.update(re.findall(r"x real time \| ([^|]*)", line))
        if len(poses) > 1:
            return output
    pytest.fail(f"it does not drive:\n{output}")


@pytest.mark.parametrize("scene", ["tricycle", "bubblerob", "ball"])
def test_demo_drives_and_leaves_a_picture_and_no_process(scene: str, tmp_path: Path) -> None:
    port = free_port()
    process = demo(tmp_path, port, scene)
    output = until_it_drives(process)
    process.send_signal(signal.SIGINT)
    output += process.communicate(timeout=120)[0]
    assert process.returncode == 0, output
    assert (tmp_path / f"demo-{scene}.png").read_bytes().startswith(b"\x89PNG")
    distance = re.search(r"distance driven +([0-9.]+) m", output)
    assert distance is not None, output
    assert float(distance[1]) > 0.0
    assert processes_with(f"ROS_MASTER_URI=http://localhost:{port}") == []


@pytest.mark.parametrize("number", [signal.SIGINT, signal.SIGTERM, signal.SIGHUP])
def test_demo_ends_in_order_on_a_signal(number: signal.Signals, tmp_path: Path) -> None:
    port = free_port()
    process = demo(tmp_path, port)
    for line in process.stdout:
        if "x real time" in line:
            break
    process.send_signal(number)
    output, _ = process.communicate(timeout=60)
    assert process.returncode == 0, output
    assert "real-time factor" in output
    assert processes_with(f"ROS_MASTER_URI=http://localhost:{port}") == []


def test_demo_states_how_to_drive_a_robot_without_a_controller(tmp_path: Path) -> None:
    process = demo(tmp_path, free_port(), "pioneer", "--seconds", "2")
    output, _ = process.communicate(timeout=120)
    assert process.returncode == 1, output
    assert "nothing moved in 2 s; if no program sends commands to the robot of 'pioneer', drive it yourself" in output
    assert "rosrun bubblesim sim pioneer --web" in output


def test_demo_states_why_the_simulator_ended(tmp_path: Path) -> None:
    process = demo(tmp_path, free_port(), "tricycel")
    output, _ = process.communicate(timeout=60)
    assert process.returncode == 1
    assert "did you mean tricycle" in output


def test_demo_uses_the_master_that_runs_and_leaves_it_as_it_was(tmp_path: Path, roscore: RosCore) -> None:
    process = demo(tmp_path, roscore.port, "ball", "--seconds", "4")
    output, _ = process.communicate(timeout=60)
    assert process.returncode == 0, output
    assert "starting a roscore" not in output
    assert "/use_sim_time" not in roscore.run("rosparam", "list")
    assert roscore.process.poll() is None


def test_demo_refuses_a_master_with_a_simulator(tmp_path: Path, roscore: RosCore) -> None:
    simulator = start(["rosrun", "bubblesim", "sim", "ball"], roscore.env, stdout=subprocess.DEVNULL)
    try:
        wait_until(lambda: "/sim_ros_interface" in roscore.nodes(), "the simulator")
        process = demo(tmp_path, roscore.port, "ball", "--seconds", "1")
        output, _ = process.communicate(timeout=60)
        assert process.returncode == 1
        assert "a simulator is already running" in output
        assert simulator.poll() is None
    finally:
        stop(simulator)
