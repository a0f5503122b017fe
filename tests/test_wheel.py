# SPDX-License-Identifier: BSD-3-Clause
"""What the wheel is built of, and its program without ROS; the build itself takes minutes."""

import re
import subprocess
import sys
import tomllib
from pathlib import Path

import pytest

from ros_support import REPOSITORY

PROJECT = tomllib.loads((REPOSITORY / "wheel" / "pyproject.toml").read_text())


def test_its_core_is_configured_without_ros(tmp_path: Path) -> None:
    """With the definitions of messages alone: nothing that catkin generates."""
    defined = PROJECT["tool"]["scikit-build"]["cmake"]["define"]
    options = [f"-D{name}={value}" for name, value in defined.items()]
    command = ["cmake", "-S", REPOSITORY, "-B", tmp_path, *options]
    run = subprocess.run(command, env={"PATH": "/usr/bin:/bin"}, capture_output=True, text=True, check=False)
    assert run.returncode == 0, run.stderr
    assert (tmp_path / "meta" / "tables" / "package_control_msgs.cpp").is_file()
    assert "catkin_DIR" not in (tmp_path / "CMakeCache.txt").read_text()
    flags = (tmp_path / "src" / "sim" / "CMakeFiles" / "bubblesim_load.dir" / "flags.make").read_text()
    assert f'"{REPOSITORY}' not in flags.replace("\\", "")  # wheels of other clones are equal


def test_it_has_the_version_of_the_package() -> None:
    (source,) = PROJECT["tool"]["dynamic-metadata"]
    assert re.search(source["regex"], (REPOSITORY / "wheel" / source["input"]).read_text()) is not None


def test_it_needs_what_its_learning_tasks_are_tested_with() -> None:
    tested = (REPOSITORY / "scripts" / "environment" / "constraints.txt").read_text()
    (gymnasium,) = PROJECT["project"]["optional-dependencies"]["learning"]
    assert gymnasium in tested.splitlines()


WITHOUT_ROS = """
import sys
sys.modules.update(dict.fromkeys(["genpy", "rosgraph", "roslib", "rospkg", "rospy"]))
from bubblesim.cli.main import program
sys.exit(program())
"""


def without_ros(folder: Path, *arguments: str) -> "subprocess.CompletedProcess[str]":
    command = [sys.executable, "-c", WITHOUT_ROS, *arguments]
    return subprocess.run(command, cwd=folder, capture_output=True, text=True, check=False)


@pytest.mark.parametrize(
    "arguments", [["--help"], ["--version"], ["scenes"], ["check", "tricycle"], ["demo", "--no-ros", "--seconds", "1"]]
)
def test_what_needs_no_ros_runs_without(arguments: list[str], tmp_path: Path) -> None:
    run = without_ros(tmp_path, *arguments)
    assert (run.returncode, run.stderr) == (0, "")


def test_what_needs_ros_states_that(tmp_path: Path) -> None:
    run = without_ros(tmp_path, "compat")
    assert (run.returncode, run.stderr) == (
        1,
        "error: this command needs the Python module rospkg: install it, or use a build with ROS\n",
    )


@pytest.mark.parametrize("arguments", [["--bogus"], ["a", "b"]])
def test_bad_usage_is_explained(arguments: list[str]) -> None:
    run = subprocess.run([REPOSITORY / "scripts" / "wheel", *arguments], capture_output=True, text=True, check=False)
    assert (run.returncode, run.stderr[:6]) == (2, "usage:")


@pytest.mark.long
def test_equal_commits_give_equal_wheels(tmp_path: Path) -> None:
    """In other clones, at other times, and with another umask."""
    wheels = []
    for clone, mask in ((tmp_path / "a", 0o022), (tmp_path / "another" / "clone", 0o027)):
        subprocess.run(["git", "clone", "--quiet", REPOSITORY, clone], umask=mask, check=True)
        (clone / ".ws").mkdir()
        (clone / ".ws" / "venv").symlink_to(REPOSITORY / ".ws" / "venv")
        subprocess.run([clone / "scripts" / "wheel"], umask=mask, stdout=subprocess.DEVNULL, check=True)
        (wheel,) = (clone / ".ws" / "wheel").glob("*.whl")
        wheels.append(wheel)
    assert wheels[0].name == wheels[1].name
    assert wheels[0].read_bytes() == wheels[1].read_bytes()
