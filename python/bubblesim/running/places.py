# SPDX-License-Identifier: BSD-3-Clause
"""Locations of the built programs."""

from __future__ import annotations

import importlib.util
from pathlib import Path

from bubblesim.running.processes import RunError


def node_program() -> Path:
    """Return the simulator's node, <prefix>/lib/bubblesim/sim, of the build of this Python package."""
    return _built(
        "lib/bubblesim/sim",
        "this build has no node, which runs scenes with their scripts and with ROS: {} is missing; build a workspace "
        "with ROS (scripts/setup), or run the scene in a Python program (bubblesim.Simulation)",
    )


def bridge_program() -> Path:
    """Return the program that passes topics between ROS 1 and ROS 2, <prefix>/lib/bubblesim/ros_bridge."""
    return _built("lib/bubblesim/ros_bridge", "this build has no ROS 2; build it with: scripts/setup --with ros2")


def scene_converter() -> Path:
    """Return the program that reads files of CoppeliaSim, <prefix>/lib/bubblesim/scene_converter."""
    return _built("lib/bubblesim/scene_converter", "the converter of scenes is missing: {}; build the workspace again")


def page_folder() -> Path:
    """Return the folder of the page of the window, <prefix>/share/bubblesim/web."""
    return _built(
        "share/bubblesim/web/index.html",
        "the page of the window is not built: {}; build it with Node.js 20 or later on PATH, or run scripts/setup",
    ).parent


def _built(file: str, problem: str) -> Path:
    """Return a file below the prefix of this Python package, or raise RunError; problem: {} stands for the path."""
    module = importlib.util.find_spec("bubblesim._core")  # without loading it
    if module is None or module.origin is None:
        raise RunError("the compiled part of bubblesim is not found; build it with: scripts/setup")
    core = Path(module.origin)
    # The package is a prefix of its own in a wheel; else it is <prefix>/lib/python3/dist-packages/bubblesim.
    prefix = core.parent if (core.parent / "lib").is_dir() else core.parents[4]
    if not (prefix / file).is_file():
        raise RunError(problem.format(prefix / file))
    return prefix / file
