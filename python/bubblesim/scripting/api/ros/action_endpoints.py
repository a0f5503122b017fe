# SPDX-License-Identifier: BSD-3-Clause
"""The endpoints of an action: what those of ROS 1 and of ROS 2 have in common."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import ExitStack, contextmanager
from typing import Any

from bubblesim import _core
from bubblesim.scripting.api.ros.stamps import Message, now

QUEUE_SIZE = 100
TIME_FORM = _core.messages.TimeForm.SEC_NANOSEC


class ActionEndpoints:
    """The topics, and in ROS 2 the services, of one action client or server."""

    def __init__(self, bridge: Any, name: str, prefix: str, note_truncations: Callable[[str, Any], None]) -> None:
        """Create none yet.

        :param prefix: of the names of the endpoints.
        :param note_truncations: called with the action's name in quotes, and the result of ``check``.
        """
        self.name = name
        self.closed = False
        self.bridge = bridge
        self._prefix = prefix
        self._note_truncations = note_truncations
        self._opened = ExitStack()

    @contextmanager
    def closed_on_error(self) -> Iterator[None]:
        """Close all endpoints if the block fails."""
        try:
            yield
        except BaseException:
            self.close()
            raise

    def close(self) -> None:
        """Shut down all endpoints."""
        self.closed = True
        self._opened.close()

    def advertise(self, topic: str, message_type: str, qos: _core.Qos | int = QUEUE_SIZE) -> int:
        """Create a publisher."""
        publisher = int(self.bridge.advertise(f"{self._prefix}/{topic}", message_type, qos))
        self._opened.callback(self.bridge.shutdown_publisher, publisher)
        return publisher

    def subscribe(self, topic: str, message_type: str, callback: Callable[[dict[str, Any]], None]) -> int:
        """Call ``callback`` with each message."""
        name = f"{self._prefix}/{topic}"
        subscriber = int(self.bridge.subscribe(name, message_type, callback, QUEUE_SIZE, TIME_FORM))
        self._opened.callback(self.bridge.shutdown_subscriber, subscriber)
        return subscriber

    def check(self, publisher: int, message: Message) -> None:
        """Raise the MessageError of a message that cannot be published, also without subscribers."""
        self._note_truncations(f"'{self.name}'", self.bridge.check(publisher, message))

    def publish(self, publisher: int, message: Message) -> None:
        """Publish a message."""
        self.bridge.publish(publisher, message)

    def now(self) -> dict[str, int]:
        """Return ROS time, for stamps."""
        return now(self.bridge)
