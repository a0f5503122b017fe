# SPDX-License-Identifier: BSD-3-Clause
"""Transforms of plugins: those that change on /tf, one message per step, and fixed ones on /tf_static."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from bubblesim._core import Qos
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
        self._needed: bool | None = None  # in this step, once it is asked
        self._fixed: dict[str, Any] = {}  # by child frame
        self._fixed_publisher: int | None = None
        self._fixed_is_new = False

    def add(self, header: Any, child: str, pose: Sequence[float]) -> None:
        """Add the pose (x, y, z, qx, qy, qz, qw) of the frame ``child`` in the frame of the header."""
        if self._publisher is None:
            self._publisher = int(self._bridge.advertise("/tf", "tf2_msgs/TFMessage", _QUEUE_SIZE))
        if self._needed is None:  # of a step all or none: a subscriber may come between two of them
            self._needed = is_needed(self._bridge, self._publisher)
        if self._needed:
            self._waiting.append(Transform(header, child, pose))

    def fix(self, header: Any, child: str, pose: Sequence[float]) -> None:
        """Publish the constant pose (x, y, z, qx, qy, qz, qw) of ``child``, also to nodes that subscribe later."""
        self._fixed[child] = Transform(header, child, pose)
        self._fixed_is_new = True

    def release(self, child: str) -> None:
        """Publish a fixed frame no more; nodes that know it keep it."""
        self._fixed_is_new = self._fixed.pop(child, None) is not None or self._fixed_is_new

    def publish(self) -> None:
        """Publish the transforms of this step."""
        if self._fixed_is_new:
            self._fixed_is_new = False
            if self._fixed_publisher is None:
                qos = Qos(1, transient_local=True)
                self._fixed_publisher = int(self._bridge.advertise("/tf_static", "tf2_msgs/TFMessage", qos))
            # All of them: the topic keeps its last message only.
            self._bridge.publish(self._fixed_publisher, transforms(list(self._fixed.values())))
        self._needed = None
        if self._waiting:
            self._bridge.publish(self._publisher, transforms(self._waiting))
            self._waiting = []
