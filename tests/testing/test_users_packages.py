# SPDX-License-Identifier: BSD-3-Clause
"""No program of ours loads a numpy or matplotlib of `pip install --user`, which may not fit Debian's modules."""

import subprocess
import sys
from pathlib import Path

import pytest

from ros_support import REPOSITORY, free_port

SETUP = REPOSITORY / ".ws" / "devel" / "setup.bash"
ACTIVATE = REPOSITORY / "scripts" / "environment" / "activate.bash"
ANYWHERE = [
    ["bubblesim", "test", "test_mine.py"],
    ["bubblesim", "sweep", "tricycle", "--seeds", "0:2", "--duration", "0.2", "--plot", "plot.png"],
    ["bubblesim", "demo", "tricycle", "--seconds", "8"],
    ["rosrun", "bubblesim", "go_to.py", "--help"],
    ["rosrun", "bubblesim", "explore.py", "--help"],
    ["rosrun", "bubblesim", "map_server", "--help"],
]
TRAINING = ["python", str(REPOSITORY / "docs/learning/train_pioneer.py"), "--iterations", "1", "--episodes", "2"]


@pytest.fixture
def home(tmp_path: Path) -> Path:
    """A home with packages that cannot be loaded, and a test of a controller."""
    packages = tmp_path / ".local" / "lib" / f"python3.{sys.version_info[1]}" / "site-packages"
    for name in ("matplotlib", "numpy"):
        (packages / name).mkdir(parents=True)
        (packages / name / "__init__.py").write_text(f"raise ImportError('the {name} of the user was loaded')\n")
    (tmp_path / "test_mine.py").write_text("def test_it(sim): sim('ball').run(0.2)\n")
    return tmp_path


def in_terminal(home: Path, file: Path, *command: str) -> "subprocess.CompletedProcess[str]":
    """Run a command in a new terminal that has sourced a file."""
    if not file.is_file():
        pytest.skip(f"no {file}: the build is elsewhere")
    environment = {
        "HOME": str(home),
        "PATH": "/usr/bin:/bin",
        "LANG": "C.UTF-8",
        "ROS_MASTER_URI": f"http://localhost:{free_port()}",
        "TMPDIR": str(home),
    }
    # In a function of its own: catkin's file takes the arguments of the shell for its own.
    shell = ["bash", "-c", f'prepare() {{ source "{file}"; }}; prepare; "$@"', "bash", *command]
    return subprocess.run(shell, env=environment, cwd=home, capture_output=True, text=True, timeout=120, check=False)


@pytest.mark.parametrize("command", ANYWHERE, ids=lambda command: command[2] if command[0] == "rosrun" else command[1])
def test_programs_take_debians(home: Path, command: list[str]) -> None:
    run = in_terminal(home, SETUP, *command)
    assert run.returncode == 0, run.stdout + run.stderr


def test_training_takes_those_of_the_virtual_environment(home: Path) -> None:
    pytest.importorskip("gymnasium")
    run = in_terminal(home, ACTIVATE, *TRAINING, "--output", str(home))
    assert run.returncode == 0, run.stdout + run.stderr


def test_they_would_be_loaded_otherwise(home: Path) -> None:
    for name in ("numpy", "matplotlib"):
        run = in_terminal(home, SETUP, "python3", "-c", f"import {name}")
        assert f"the {name} of the user was loaded" in run.stderr
