# SPDX-License-Identifier: BSD-3-Clause
"""Rebuilds bubblesim in its workspace."""

from __future__ import annotations

import shlex
import subprocess
import sys
from pathlib import Path

from bubblesim.messages.packages import find_workspace


class BuildError(Exception):
    """There is no build, or it failed; the text states what to do."""


def rebuild(project: Path) -> None:
    """Run the workspace's build tool for bubblesim only; it shows its own progress."""
    workspace = find_workspace(project)
    if workspace is None:
        raise BuildError(f"{project} is not in a catkin workspace; rebuild it with CMake")
    command = build_command(workspace)
    try:
        result = subprocess.run(command, cwd=workspace, check=False).returncode
    except FileNotFoundError as error:
        raise BuildError(f"{command[0]} is not installed: {error}") from error
    if result != 0:
        raise BuildError(f"'{shlex.join(command)}' in {workspace} failed with exit code {result}; see its errors above")


def build_command(workspace: Path) -> list[str]:
    """Return the command of the tool that created the workspace: each tool needs its own build folders."""
    marker = workspace / "build" / ".built_by"
    built_by = marker.read_text(encoding="utf-8").strip() if marker.is_file() else ""
    if built_by == "catkin_make" or not (workspace / ".catkin_tools").is_dir():
        return ["catkin_make", "--directory", str(workspace), "--pkg", "bubblesim"]
    look = [] if sys.stdout.isatty() else ["--no-status", "--no-color"]
    return ["catkin", "build", "bubblesim", "--no-deps", "--no-notify", *look, "--workspace", str(workspace)]
