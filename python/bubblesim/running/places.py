# SPDX-License-Identifier: BSD-3-Clause
"""Locations of the built programs."""

from __future__ import annotations

import importlib.util
from pathlib import Path

from bubblesim.running.processes import RunError


def node_program() -> Path:
    """Return the simulator's node, <prefix>/lib/bubblesim/sim, of the build of this Python package."""
    # This module is in <prefix>/lib/python3/dist-packages/bubblesim.
    core = importlib.util.find_spec("bubblesim._core")  # without loading it
    program = Path((core and core.origin) or "").parents[3] / "bubblesim" / "sim"
    if not program.is_file():
        raise RunError(f"the node is not built: file not found: {program}; build the workspace with ROS")
    return program


def bridge_program() -> Path:
    """Return the program that passes topics between ROS 1 and ROS 2, <prefix>/lib/bubblesim/ros_bridge."""
    core = importlib.util.find_spec("bubblesim._core")
    program = Path((core and core.origin) or "").parents[3] / "bubblesim" / "ros_bridge"
    if not program.is_file():
        raise RunError("this build has no ROS 2; build it with: scripts/setup --with ros2")
    return program


def scene_converter() -> Path:
    """Return the program that reads files of CoppeliaSim, <prefix>/lib/bubblesim/scene_converter."""
    core = importlib.util.find_spec("bubblesim._core")
    program = Path((core and core.origin) or "").parents[3] / "bubblesim" / "scene_converter"
    if not program.is_file():
        raise RunError(f"the converter of scenes is not built: file not found: {program}; build the workspace")
    return program


def page_folder() -> Path:
    """Return the folder of the page of the window, <prefix>/share/bubblesim/web."""
    core = importlib.util.find_spec("bubblesim._core")
    folder = Path((core and core.origin) or "").parents[4] / "share" / "bubblesim" / "web"
    if not (folder / "index.html").is_file():
        raise RunError(
            f"the page of the window is not built: {folder}; build it with Node.js 20 or later on PATH, or run "
            "scripts/setup"
        )
    return folder
