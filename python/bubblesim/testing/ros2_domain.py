# SPDX-License-Identifier: BSD-3-Clause
"""The ROS 2 domain of a test, and the environment of its nodes."""

from __future__ import annotations

import os
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path

_PATHS = ("PYTHONPATH", "LD_LIBRARY_PATH")


@dataclass(frozen=True)
class Ros2Domain:
    """A domain that no other test on this machine uses."""

    number: int

    @property
    def environment(self) -> dict[str, str]:
        """Return the environment variables with which nodes join it; nodes of other machines stay outside."""
        discovery = os.environ.get("ROS_AUTOMATIC_DISCOVERY_RANGE", "LOCALHOST")
        return {"ROS_DOMAIN_ID": str(self.number), "ROS_AUTOMATIC_DISCOVERY_RANGE": discovery}


def without_ros1(environment: Mapping[str, str]) -> dict[str, str]:
    """Return an environment without the paths that workspaces of catkin have added.

    Their Python packages have the names of those of ROS 2, such as std_msgs.
    """
    prefixes = [Path(place) for place in environment.get("CMAKE_PREFIX_PATH", "").split(":") if place]
    workspaces = [prefix for prefix in prefixes if (prefix / ".catkin").exists()]
    changed = dict(environment)
    for name in _PATHS:
        if name in changed:
            kept = [entry for entry in changed[name].split(":") if not _is_within(Path(entry), workspaces)]
            changed[name] = ":".join(kept)
            if not kept:
                del changed[name]
    return changed


def _is_within(place: Path, folders: list[Path]) -> bool:
    return any(place.is_relative_to(folder) for folder in folders)
