# SPDX-License-Identifier: BSD-3-Clause
"""What a child script finds in place of `simROS` and `simROS2` when the node runs without ROS."""

from __future__ import annotations

from typing import Any, NoReturn


class NoRosError(AttributeError):
    """A script used a function of ROS, and there is no ROS."""


class NoRos:
    """False in conditions; any other use raises a NoRosError."""

    def __init__(self, name: str) -> None:
        """Stand in for the module ``name``."""
        self._name = name

    def __bool__(self) -> bool:
        """Let `if simROS:` skip what needs ROS."""
        return False

    def __getattr__(self, wanted: str) -> NoReturn:
        """All functions and constants."""
        raise NoRosError(f"{self._name}.{wanted}: {reason(self._name)}")

    def __repr__(self) -> str:
        """Printed by scripts that look for the reason of their failure."""
        return f"<{self._name}: {reason(self._name)}>"


def reason(name: Any) -> str:
    """Why a module is not there, and what a script can do."""
    return f"there is no ROS because the node was started with --no-ros; scripts for both cases test `if {name}`"
