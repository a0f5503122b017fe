# SPDX-License-Identifier: BSD-3-Clause
"""Builds bubblesim again where it was built."""

from __future__ import annotations

import shlex
import subprocess
import sys
from pathlib import Path

from bubblesim.messages.packages import find_workspace


class BuildError(Exception):
    """There is no build, or it failed; the text says what to do."""


def rebuild(project: Path) -> None:
    """Run the workspace's build tool for bubblesim alone; it shows its own progress."""
    workspace = find_workspace(project)
    if workspace is None:
        raise BuildError(f"{project} lies in no catkin workspace; build it as you did before, with CMake")
    command = build_command(workspace)
    try:
        result = subprocess.run(command, cwd=workspace, check=False).returncode
    except FileNotFoundError as error:
        raise BuildError(f"{command[0]} is not installed: {error}") from error
    if result != 0:
        raise BuildError(f"'{shlex.join(command)}' in {workspace} ended with {result}; its errors are above")


def build_command(workspace: Path) -> list[str]:
    """The command of the tool that made the workspace: the two do not build in each other's folders."""
    marker = workspace / "build" / ".built_by"
    built_by = marker.read_text(encoding="utf-8").strip() if marker.is_file() else ""
    if built_by == "catkin_make" or not (workspace / ".catkin_tools").is_dir():
        return ["catkin_make", "--directory", str(workspace), "--pkg", "bubblesim"]
    look = [] if sys.stdout.isatty() else ["--no-status", "--no-color"]
    return ["catkin", "build", "bubblesim", "--no-deps", "--no-notify", *look, "--workspace", str(workspace)]
