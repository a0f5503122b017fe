# SPDX-License-Identifier: BSD-3-Clause
"""bubblesim new-scene."""

import os
import pty
import re
from pathlib import Path

import pytest

from cli_support import bubblesim
from node_support import Node, run_sim, without_slowness
from ros_support import RosCore, built, start, wait_until


def test_the_new_scene_runs_as_it_is(tmp_path: Path) -> None:
    made = bubblesim("new-scene", "mine", cwd=tmp_path)
    assert (made.returncode, made.stdout) == (0, "mine.sdf\nmine.py\n")
    assert "bubblesim run ./mine.sdf" in made.stderr
    run = bubblesim("run", "./mine.sdf", "--no-ros", "--speed", "max", "--until", 4, "--strict", cwd=tmp_path)
    assert (run.returncode, without_slowness(run.stderr)) == (0, "")
    x, y = (float(number.strip(",")) for number in run.stdout.split("robot is at ")[1].split()[:2])
    # Wheels of 0.05 m, 0.24 m apart, at 4 and 6 rad/s: 0.25 m/s and 0.42 rad/s, a circle of 0.6 m about (0.05, 0.6).
    assert abs((((x - 0.05) ** 2 + (y - 0.6) ** 2) ** 0.5) - 0.6) < 0.1
    assert y > 0.3


@pytest.mark.parametrize(
    ("template", "seconds", "expected"),
    [
        ("arm", 5.9, r"the joints are at -0.80, 0.60, 1.20 rad"),  # the third pose
        ("drone", 7.9, r"the quadcopter is at (0.9|1.0)\d, -?0.0\d, (0.9|1.0)\d m"),  # the second goal
        ("empty", 1, r"^$"),
    ],
)
def test_each_template_moves_as_its_script_commands(
    tmp_path: Path, template: str, seconds: float, expected: str
) -> None:
    bubblesim("new-scene", "mine", "--template", template, cwd=tmp_path)
    run = bubblesim("run", "./mine.sdf", "--no-ros", "--speed", "max", "--until", seconds, "--strict", cwd=tmp_path)
    assert (run.returncode, without_slowness(run.stderr)) == (0, "")
    assert re.search(expected, run.stdout), run.stdout
    assert bubblesim("check", "./mine.sdf", cwd=tmp_path).stdout == "./mine.sdf: fine\n"


def test_a_terminal_is_asked_for_the_template(tmp_path: Path) -> None:
    ours, theirs = pty.openpty()
    try:
        run = start(
            [str(built("bubblesim")), "new-scene", "mine"], dict(os.environ), cwd=tmp_path, stdin=theirs, stderr=theirs
        )
        os.write(ours, b"9\n2\n")
        assert run.wait(60) == 0
        assert os.read(ours, 4096).count(b"template [1]:") == 2
    finally:
        os.close(ours)
        os.close(theirs)
    assert 'model name="Arm"' in (tmp_path / "mine.sdf").read_text()


def test_the_new_scene_talks_to_ros(tmp_path: Path, roscore: RosCore) -> None:
    bubblesim("new-scene", "mine", "--folder", tmp_path)
    with Node(roscore.env, tmp_path / "log", tmp_path / "mine.sdf", "--strict"):
        wait_until(lambda: {"/sonar", "/tf"} <= set(roscore.state()["publishers"]), "the topics of the scene")
        assert "range_max: 8.0" in roscore.echo("/scan")
        assert {"/left", "/right"} <= set(roscore.state()["subscribers"])
        assert "data: " in roscore.echo("/sonar")


@pytest.mark.parametrize("name", ["", "1st", "my scene", "../up", "a.b"])
def test_names_that_are_none_are_refused(tmp_path: Path, name: str) -> None:
    run = bubblesim("new-scene", name, cwd=tmp_path)
    assert run.returncode == 2
    assert f"'{name}' is not a valid scene name" in run.stderr
    assert ("its folder is given by --folder" in run.stderr) == ("/" in name)
    assert list(tmp_path.iterdir()) == []


def test_nothing_is_overwritten(tmp_path: Path) -> None:
    (tmp_path / "mine.py").write_text("precious")
    run = bubblesim("new-scene", "mine", cwd=tmp_path)
    assert run.returncode == 2
    assert "mine.py already exists" in run.stderr
    assert [file.read_text() for file in tmp_path.iterdir()] == ["precious"]


def test_a_folder_that_is_not_there_is_reported(tmp_path: Path) -> None:
    run = bubblesim("new-scene", "mine", "--folder", tmp_path / "none")
    assert run.returncode == 2
    assert "No such file or directory" in run.stderr


def test_its_scene_has_no_warnings(tmp_path: Path) -> None:
    bubblesim("new-scene", "mine", cwd=tmp_path)
    run = run_sim(tmp_path / "mine.sdf", "--no-ros", "--until", 0.05)
    assert without_slowness(run.stderr) == ""
