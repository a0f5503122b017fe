# SPDX-License-Identifier: BSD-3-Clause
"""`simROS` functions for transforms."""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping
from typing import Any

from bubblesim import _core
from bubblesim.scripting.api.ros.kinds import Transforms
from bubblesim.scripting.api.ros.stamps import Message
from bubblesim.scripting.api.ros.topics import RosTopics
from bubblesim.scripting.caller import Caller

_QUEUE_SIZE = 100
_TYPE = "tf2_msgs/TFMessage"
# tf2 ignores transforms whose squared norm differs from 1 by more (tf2::QUATERNION_NORMALIZATION_TOLERANCE).
_LENGTH_TOLERANCE = 10e-3


class RosTransforms(RosTopics):
    """Transforms are dicts of geometry_msgs/TransformStamped; metres, unit quaternions x, y, z, w."""

    def __init__(self, bridge: Any, simulation: Any, caller: Caller) -> None:
        """Bind the functions to one script."""
        super().__init__(bridge, simulation, caller)
        self._tf_publisher: int | None = None
        self._static_publisher: int | None = None
        self._static_transforms: dict[str, Message] = {}  # by child frame

    def sendTransform(self, transform: Message) -> None:
        """Publish a transform on /tf."""
        self.sendTransforms([transform])

    def sendTransforms(self, transforms: Transforms) -> None:
        """Publish several transforms in one message.

        Raises a ValueError, and publishes none, if one has no unit quaternion or a number that is not finite.
        """
        checked = _checked(transforms)
        if self._tf_publisher is None:
            self._tf_publisher = self._advertise("/tf", _TYPE, _QUEUE_SIZE)
        self.publish(self._tf_publisher, {"transforms": checked})

    def sendStaticTransform(self, transform: Message) -> None:
        """Publish a static transform on /tf_static; later subscribers also get it."""
        self.sendStaticTransforms([transform])

    def sendStaticTransforms(self, transforms: Transforms) -> None:
        """Publish several static transforms; a transform replaces the previous one of the same child frame."""
        # Send all each time, because a latched topic keeps only its last message.
        all_transforms = self._static_transforms | {_child_frame(each): each for each in _checked(transforms)}
        message = {"transforms": list(all_transforms.values())}
        if self._static_publisher is None:
            depth = 1 if self._is_ros2 else _QUEUE_SIZE  # in ROS 2 it is also the number of messages that are kept
            self._static_publisher = self._advertise("/tf_static", _TYPE, _core.Qos(depth, transient_local=True))
        self.publish(self._static_publisher, message)
        self._static_transforms = all_transforms


def _checked(transforms: Iterable[Message]) -> list[Message]:
    checked = list(transforms)
    for transform in checked:
        _check(transform)
    return checked


def _check(transform: object) -> None:
    """Reject numbers that tf2 rejects; values that are not transforms are reported by the conversion."""
    parts = transform.get("transform", {}) if isinstance(transform, Mapping) else None
    if not isinstance(transform, Mapping) or not isinstance(parts, Mapping):
        return
    where = f"the transform of '{_child_frame(transform)}'"
    translation = _numbers(parts.get("translation", {}), "xyz")
    rotation = _numbers(parts.get("rotation", {}), "xyzw")
    if translation is None or rotation is None:
        return
    for name, numbers in (("translation", translation), ("rotation", rotation)):
        if not all(map(math.isfinite, numbers)):
            raise ValueError(f"{where}: {name} {numbers} is not finite")
    if abs(sum(number * number for number in rotation) - 1.0) > _LENGTH_TOLERANCE:
        raise ValueError(
            f"{where}: rotation {rotation} is not a unit quaternion (x, y, z, w), its norm is "
            f"{math.hypot(*rotation):.6g}; the identity is 0, 0, 0, 1"
        )


def _numbers(vector: object, names: str) -> list[float] | None:
    """Return the vector's numbers, 0 for omitted ones; None if it does not hold numbers."""
    if not isinstance(vector, Mapping):
        return None
    try:
        return [float(vector.get(name, 0.0)) for name in names]
    except (TypeError, ValueError):
        return None


def _child_frame(transform: Message) -> str:
    return str(transform.get("child_frame_id", "")) if isinstance(transform, Mapping) else ""
