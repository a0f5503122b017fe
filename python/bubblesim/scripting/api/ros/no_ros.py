# SPDX-License-Identifier: BSD-3-Clause
"""Replaces `simROS` and `simROS2` in child scripts when the node runs without ROS."""

from __future__ import annotations

from typing import Any, NoReturn


class NoRosError(AttributeError):
    """A script used a function of ROS, but the node runs without ROS."""


class NoRos:
    """False in conditions; any other use raises a NoRosError."""

    def __init__(self, name: str) -> None:
        """Replace the module ``name``."""
        self._name = name

    def __bool__(self) -> bool:
        """Return False, so that `if simROS:` skips code that needs ROS."""
        return False

    def __getattr__(self, wanted: str) -> NoReturn:
        """Raise an error for all functions and constants."""
        raise NoRosError(f"{self._name}.{wanted}: {reason(self._name)}")

    def __repr__(self) -> str:
        """Show the reason when a script prints the module."""
        return f"<{self._name}: {reason(self._name)}>"


def reason(name: Any) -> str:
    """Return why a module is not available, and what a script can do."""
    return f"the node was started with --no-ros; to run with and without ROS, test `if {name}`"
