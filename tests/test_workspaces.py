# SPDX-License-Identifier: BSD-3-Clause
"""The package in a user's catkin workspace: both tools, devel and install spaces, and a user's test_msgs.

Each is a full build of some minutes; a link to the clone replaces the clone.
"""

import os
import shutil
import subprocess
from pathlib import Path

import pytest

from ros_support import REPOSITORY

pytestmark = pytest.mark.long

TOOLS = {
    "catkin build": (["catkin init", "catkin build --no-status --no-notify"], "devel"),
    "catkin build, installed": (
        ["catkin init", "catkin config --install", "catkin build --no-status --no-notify"],
        "install",
    ),
    "catkin_make": (["catkin_make"], "devel"),
    "catkin_make install": (["catkin_make install"], "install"),
}
USERS_MESSAGE = "string messages\nint32 mine\n"


def fresh_environment() -> dict[str, str]:
    """Return the environment of a new terminal without a sourced workspace."""
    kept = ("HOME", "USER", "LANG", "TERM", "CCACHE_DIR")
    environment = {name: os.environ[name] for name in kept if name in os.environ}
    return environment | {"PATH": "/usr/local/bin:/usr/bin:/bin"}


def make_workspace(folder: Path, tool: str) -> Path:
    """Build a workspace with the clone in it. Return the space to source."""
    (folder / "src" / "bubblesim").parent.mkdir(exist_ok=True)
    (folder / "src" / "bubblesim").symlink_to(REPOSITORY)
    commands, space = TOOLS[tool]
    for command in commands:
        subprocess.run(command.split(), cwd=folder, env=fresh_environment(), check=True)
    return folder / space


def in_space(space: Path, command: str) -> str:
    """Return the output of a command in a terminal that has sourced the space."""
    return subprocess.run(
        ["bash", "-c", f"source {space}/setup.bash && cd / && {command}"],
        env=fresh_environment(),
        stdin=subprocess.DEVNULL,
        stdout=subprocess.PIPE,
        text=True,
        check=True,
    ).stdout


@pytest.mark.parametrize("tool", TOOLS)
def test_builds_and_works(tool: str, tmp_path: Path) -> None:
    space = make_workspace(tmp_path, tool)
    assert in_space(space, "rosmsg show test_msgs/Notification").strip() == "string messages"
    assert "tricycle" in in_space(space, "rosrun bubblesim sim --list-scenes")
    assert "usage" in in_space(space, "rosrun bubblesim tricycle_avoid.py --help")
    assert "usage" in in_space(space, "rosrun bubblesim rosBubbleRob --help")
    assert "/sim_ros_interface" in in_space(space, "roslaunch --nodes bubblesim tricycle.launch")
    in_space(space, "rosrun bubblesim sim tricycle --no-ros --speed max --until 1")
    python = 'import bubblesim; bubblesim.Simulation("tricycle").step(10)'
    in_space(space, f"/usr/bin/python3 -c '{python}'")


@pytest.mark.parametrize("tool", ["catkin build", "catkin_make"])
def test_the_users_own_test_msgs_wins(tool: str, tmp_path: Path) -> None:
    own = tmp_path / "src" / "their_messages"
    shutil.copytree(REPOSITORY / "msg" / "test_msgs", own)
    (own / "msg" / "Notification.msg").write_text(USERS_MESSAGE)
    space = make_workspace(tmp_path, tool)
    assert in_space(space, "rosmsg show test_msgs/Notification").strip() == USERS_MESSAGE.strip()
    slots = in_space(space, "/usr/bin/python3 -c 'from test_msgs.msg import Notification as N; print(N.__slots__)'")
    assert "mine" in slots
