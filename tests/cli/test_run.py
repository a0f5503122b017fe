# SPDX-License-Identifier: BSD-3-Clause
"""bubblesim run."""

import os
import signal
import subprocess
from pathlib import Path

import pytest

from cli_support import bubblesim
from node_support import processes_with, without_slowness
from ros_support import RosCore, built, free_port, ros_environment, start, wait_until

FAST = ["--speed", "max", "--until", "2"]


def test_the_node_gets_its_options_and_gives_its_exit_code() -> None:
    run = bubblesim("run", "ball", "--no-ros", *FAST, "--state-hash")
    assert (run.returncode, len(run.stdout), without_slowness(run.stderr)) == (0, 17, "")
    bad = bubblesim("run", "bal", "--no-ros")
    assert bad.returncode == 2
    assert "did you mean ball?" in bad.stderr


def test_help_shows_the_options_of_the_node_too() -> None:
    text = bubblesim("run", "--help").stdout
    assert "--roscore" in text
    assert "--lua-unsafe" in text


def test_options_before_the_scene_are_refused() -> None:
    run = bubblesim("run", "--until", "3", "ball")
    assert run.returncode == 2
    assert "the scene comes first" in run.stderr


@pytest.mark.parametrize(
    ("arguments", "answer"),
    [
        (["tricycle.launch"], "tricycle.launch is a launch file, not a scene: roslaunch bubblesim tricycle.launch"),
        (["."], ". is a folder, not a scene: give the .sdf file in it, or a name of `bubblesim scenes`"),
        (["ball", "--plot", "path.gif"], "--plot: path.gif does not end with .png or .pdf or .svg, the formats of"),
        (["ball", "--plot", "/nowhere/path.png"], "--plot: there is no folder /nowhere: make it first"),
    ],
)
def test_what_would_fail_later_is_refused_before_the_run(arguments: list[str], answer: str, tmp_path: Path) -> None:
    run = bubblesim("run", *arguments, cwd=tmp_path)
    assert (run.returncode, run.stderr[: len(answer) + 7]) == (2, f"error: {answer}")


def test_a_roscore_and_a_controller_come_and_go_with_it_and_the_path_is_drawn(tmp_path: Path) -> None:
    port = free_port()
    options = ["--roscore", "--controller", "rosrun bubblesim tricycle_avoid.py", "--plot", tmp_path / "path.png"]
    run = bubblesim("run", "tricycle", "--until", 3, *options, env=ros_environment(port, tmp_path / "log"))
    assert run.returncode == 0, run.stderr
    assert f"no ROS master at http://localhost:{port}: starting a roscore" in run.stderr
    assert "distance driven" in run.stderr
    assert (tmp_path / "path.png").read_bytes().startswith(b"\x89PNG")
    assert processes_with(f"-p {port}") == []


def test_the_whole_path_of_a_short_run_at_full_speed_is_drawn(tmp_path: Path) -> None:
    options = ["--roscore", "--speed", "max", "--plot", tmp_path / "path.png"]
    run = bubblesim("run", "bubblerob", "--until", 0.5, *options, env=ros_environment(free_port(), tmp_path / "log"))
    assert run.returncode == 0, run.stderr
    assert "simulated time     0.4" in run.stderr
    assert (tmp_path / "path.png").read_bytes().startswith(b"\x89PNG")


def test_a_master_that_is_needed_and_missing_is_reported(tmp_path: Path) -> None:
    environment = ros_environment(free_port(), tmp_path)
    run = bubblesim("run", "tricycle", "--plot", tmp_path / "path.png", env=environment)
    assert run.returncode == 1
    assert "add --roscore" in run.stderr


@pytest.mark.parametrize("number", [signal.SIGINT, signal.SIGTERM, signal.SIGHUP])
def test_signals_end_all_of_it(tmp_path: Path, number: signal.Signals) -> None:
    port = free_port()
    log = tmp_path / "out"
    own = ["--seed", str(port)]  # identifies the node among others
    with log.open("w") as output:
        process = start(
            [str(built("bubblesim")), "run", "ball", "--roscore", *own],
            ros_environment(port, tmp_path / "log"),
            stdout=output,
            stderr=subprocess.STDOUT,
        )
    wait_until(lambda: processes_with(f"{built('sim')} ball {' '.join(own)}") != [], "the node to start", 60)
    process.send_signal(number)
    assert process.wait(timeout=60) == 0, log.read_text()
    assert processes_with(f"-p {port}") == []


def test_a_controller_that_ends_is_reported_and_ends_the_run(roscore: RosCore) -> None:
    run = bubblesim("run", "ball", "--controller", "sh -c 'exit 3'", env={**os.environ, **roscore.env})
    assert run.returncode == 1
    assert "the controller ended with exit code 3" in run.stderr


def test_a_program_of_a_package_is_found_by_rosrun(roscore: RosCore) -> None:
    run = bubblesim("run", "ball", "--controller", "tricycle_avoid", *FAST, env=roscore.env)
    assert run.returncode == 1
    assert (
        "cannot start the controller: tricycle_avoid: No such file or directory; a program of a package is "
        in run.stderr
    )
    assert "started with rosrun PACKAGE tricycle_avoid" in run.stderr


def test_a_controller_that_is_not_there_is_reported(roscore: RosCore) -> None:
    run = bubblesim("run", "ball", "--controller", "no_such_program", env=roscore.env)
    assert run.returncode == 1
    assert "cannot start the controller: no_such_program: No such file" in run.stderr
