# SPDX-License-Identifier: BSD-3-Clause
"""Which nodes of a ROS master advance the time of the others."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any


def simulators(state: Sequence[Sequence[Any]], topic: str = "/clock") -> list[str]:
    """Return the nodes that publish ``topic`` and can be paused: simulators, Gazebo, `rosbag play --clock`.

    The bridge between ROS 1 and ROS 2 publishes it, too, and is none.

    :param state: publishers, subscribers and services, as the master returns them (getSystemState).
    """
    publishers, _, services = state
    nodes = {node for name, nodes in publishers if name == topic for node in nodes}
    pausable = {node for node in nodes for name, _ in services if name.startswith(f"{node}/pause")}
    return sorted(pausable)
