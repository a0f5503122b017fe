# SPDX-License-Identifier: BSD-3-Clause
"""Transforms of plugins on /tf, one message per step."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from bubblesim._core.reading_messages import Transform, transforms

_QUEUE_SIZE = 100


def is_needed(bridge: Any, publisher: int) -> bool:
    """Return whether the topic has subscribers or is recorded to a bag."""
    return bool(bridge.wants_messages(publisher) or getattr(bridge, "keeps_all", False))


class Transforms:
    """Collects transforms; the topic is advertised with the first one."""

    def __init__(self, bridge: Any) -> None:
        """Use this bridge."""
        self._bridge = bridge
        self._publisher: int | None = None
        self._waiting: list[Any] = []

    def add(self, header: Any, child: str, pose: Sequence[float]) -> None:
        """Add the pose (x, y, z, qx, qy, qz, qw) of the frame ``child`` in the frame of the header."""
        if self._publisher is None:
            self._publisher = int(self._bridge.advertise("/tf", "tf2_msgs/TFMessage", _QUEUE_SIZE))
        if is_needed(self._bridge, self._publisher):
            self._waiting.append(Transform(header, child, pose))

    def publish(self) -> None:
        """Publish the transforms of this step."""
        if self._waiting:
            self._bridge.publish(self._publisher, transforms(self._waiting))
            self._waiting = []
