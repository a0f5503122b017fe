# SPDX-License-Identifier: BSD-3-Clause
"""The bridges to ROS 1 and ROS 2 as one, for what the node itself publishes, receives and offers."""

from __future__ import annotations

import sys
from collections.abc import Callable
from typing import Any

from bubblesim import _core
from bubblesim.program.output import write_line

Handles = tuple[int | None, int | None]  # on ROS 1 and on ROS 2; None: this side does not have its type


class BothBridges:
    """Has the functions of ``bubblesim._core.Bridge``. Scripts use a side of it: see ``bridge_of``."""

    def __init__(self, ros1: Any, ros2: Any) -> None:
        """Join two bridges; they may be ObservedBridges."""
        self.ros1 = ros1
        self.ros2 = ros2
        self._handles: dict[int, Handles] = {}
        self._next = 1

    @property
    def keeps_all(self) -> bool:
        """Return whether an observer uses all messages, also those without subscribers."""
        return any(getattr(side, "keeps_all", False) for side in (self.ros1, self.ros2))

    def advertise(self, topic: str, message_type: str, qos: Any) -> int:
        """Advertise a topic on both sides."""
        return self._make(lambda side: side.advertise(topic, message_type, qos))

    def publish(self, publisher: int, message: Any) -> Any:
        """Publish on the sides that have subscribers: a conversion each, none without."""
        results = self._on_each(publisher, lambda side, handle: side.publish(handle, message))
        return next((truncations for truncations in results if truncations is not None), None)

    def check(self, publisher: int, message: Any) -> Any:
        """Convert a message for both sides without sending it."""
        results = self._on_each(publisher, lambda side, handle: side.check(handle, message))
        return next((truncations for truncations in results if truncations is not None), None)

    def wants_messages(self, publisher: int) -> bool:
        """Return whether a side has subscribers."""
        return any(self._on_each(publisher, lambda side, handle: side.wants_messages(handle)))

    def subscribe(self, topic: str, message_type: str, callback: Any, qos: Any, time: Any) -> int:
        """Subscribe on both sides."""
        return self._make(lambda side: side.subscribe(topic, message_type, callback, qos, time))

    def subscribe_numbers(self, topic: str, message_type: str, fields: Any, target: Any, refused: Any, qos: Any) -> int:
        """Subscribe to numbers on both sides."""
        return self._make(lambda side: side.subscribe_numbers(topic, message_type, fields, target, refused, qos))

    def advertise_service(self, name: str, service_type: str, callback: Any, time: Any) -> int:
        """Advertise a service on both sides."""
        return self._make(lambda side: side.advertise_service(name, service_type, callback, time))

    def yield_topic(self, endpoint: int) -> None:
        """Make an endpoint inactive on the sides where scripts use its topic."""
        self._on_each(endpoint, lambda side, handle: side.yield_topic(handle))

    def set_priority(self, endpoint: int) -> None:
        """Include an endpoint in urgent_waits()."""
        self._on_each(endpoint, lambda side, handle: side.set_priority(handle))

    def urgent_waits(self) -> bool:
        """Return whether a priority endpoint has pending input. Thread-safe."""
        return bool(self.ros1.urgent_waits() or self.ros2.urgent_waits())

    def has_publisher(self, subscriber: int) -> bool:
        """Return whether a side has a publisher."""
        return any(self._on_each(subscriber, lambda side, handle: side.has_publisher(handle)))

    def shutdown_publisher(self, publisher: int) -> None:
        """Shut down a publisher on both sides."""
        self._end(publisher, lambda side, handle: side.shutdown_publisher(handle))

    def shutdown_subscriber(self, subscriber: int) -> None:
        """Shut down a subscriber on both sides."""
        self._end(subscriber, lambda side, handle: side.shutdown_subscriber(handle))

    def shutdown_service_server(self, server: int) -> None:
        """Shut down a service on both sides."""
        self._end(server, lambda side, handle: side.shutdown_service_server(handle))

    def get_parameter(self, name: str) -> tuple[bool, Any]:
        """Return (exists, value) of a parameter of the ROS 2 node, else of ROS 1."""
        found: tuple[bool, Any] = self.ros2.get_parameter(name)
        return found if found[0] else self.ros1.get_parameter(name)

    def now(self) -> tuple[int, int]:
        """Return the time of ROS 1 for stamps as (sec, nanosec); it is that of both where both use the same clock."""
        time: tuple[int, int] = self.ros1.now()
        return time

    def clock_reaches_others(self) -> bool:
        """Return whether /clock reaches another node on each side that uses it."""
        return bool(self.ros1.clock_reaches_others() and self.ros2.clock_reaches_others())

    def _make(self, make: Callable[[Any], int]) -> int:
        made: list[int | None] = []
        errors: list[_core.MessageError] = []
        for side in (self.ros1, self.ros2):
            try:
                made.append(make(side))
            except _core.MessageError as missing:  # this side does not have the type
                errors.append(missing)
                made.append(None)
        if len(errors) == 2:
            raise errors[0]
        for error in errors:
            write_line(sys.stderr, f"info: with ROS {2 if made[0] else 1} alone: {error}")
        handle, self._next = self._next, self._next + 1
        self._handles[handle] = (made[0], made[1])
        return handle

    def _on_each(self, handle: int, call: Callable[[Any, int], Any]) -> list[Any]:
        if handle not in self._handles:
            raise ValueError(f"invalid object handle {handle}: no such endpoint, or it was shut down")
        sides = zip((self.ros1, self.ros2), self._handles[handle], strict=True)
        return [call(side, own) for side, own in sides if own is not None]

    def _end(self, handle: int, call: Callable[[Any, int], Any]) -> None:
        self._on_each(handle, call)
        del self._handles[handle]


def bridge_of(bridge: Any, version: _core.messages.RosVersion) -> Any:
    """Return the bridge that a script's module of this version uses; one bridge alone serves both."""
    if not isinstance(bridge, BothBridges):
        return bridge
    return bridge.ros2 if version == _core.messages.RosVersion.ROS2 else bridge.ros1
