# SPDX-License-Identifier: BSD-3-Clause
"""A bridge that notifies observers of its messages: for bags, and for lockstep with a controller."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from functools import reduce
from operator import getitem
from typing import Any, Protocol

from bubblesim._core import Qos
from bubblesim._core.messages import TimeForm
from bubblesim.observers.lock_step import LockStep


class Observer(Protocol):
    """Notified of what scripts do with topics."""

    def advertised(self, publisher: int) -> None:
        """A script has advertised a topic."""

    def subscribed(self, topic: str, subscriber: int) -> None:
        """A script has subscribed."""

    def published(self, topic: str, message_type: str, message: Any) -> None:
        """A script has published."""

    def received(self, topic: str, message_type: str, message: Any) -> None:
        """A message was received, before the script's callback."""

    def input_processed(self) -> None:
        """Pending input was processed; called often, also while the simulation is not running."""

    def step_done(self) -> None:
        """A step is complete."""

    def close(self) -> None:
        """The simulation ends."""


class ObservedBridge:
    """Wraps a bridge; see ``bubblesim._core.Bridge``."""

    def __init__(
        self, bridge: Any, observers: list[Observer], *, keeps_all: bool = False, lockstep: LockStep | None = None
    ) -> None:
        """Create it without publishers.

        :param keeps_all: an observer uses all messages, also those without subscribers.
        :param lockstep: what is published before its connections are complete is checked, but not sent; latched
            messages are.
        """
        self.observers = observers
        self.keeps_all = keeps_all
        self._bridge = bridge
        self._lockstep = lockstep
        self._published: dict[int, tuple[str, str]] = {}  # topic and type by publisher
        self._latched: set[int] = set()

    @property
    def unobserved(self) -> Any:
        """Return the bridge itself, for topics that are in no recording."""
        return self._bridge

    def __getattr__(self, name: str) -> Any:
        """Forward all functions that are not observed."""
        return getattr(self._bridge, name)

    def advertise(self, topic: str, message_type: str, qos: Qos | int) -> int:
        """Advertise a topic and notify the observers."""
        publisher: int = self._bridge.advertise(topic, message_type, qos)
        self._published[publisher] = topic, message_type
        if isinstance(qos, Qos) and qos.transient_local:
            self._latched.add(publisher)
        for observer in self.observers:
            observer.advertised(publisher)
        return publisher

    def publish(self, publisher: int, message: Any) -> Any:
        """Publish, and notify the observers."""
        withheld = self._lockstep is not None and not self._lockstep.connected and publisher not in self._latched
        truncations = (self._bridge.check if withheld else self._bridge.publish)(publisher, message)
        for observer in self.observers:
            observer.published(*self._published[publisher], message)
        return truncations

    def subscribe(
        self, topic: str, message_type: str, callback: Callable[[Any], object], *arguments: Any, **named: Any
    ) -> int:
        """Subscribe, and notify the observers of messages."""

        def deliver(message: Any) -> None:
            for observer in self.observers:
                observer.received(topic, message_type, message)
            callback(message)

        subscriber: int = self._bridge.subscribe(topic, message_type, deliver, *arguments, **named)
        for observer in self.observers:
            observer.subscribed(topic, subscriber)
        return subscriber

    def subscribe_numbers(
        self,
        topic: str,
        message_type: str,
        fields: Sequence[str],
        target: Callable[[list[float]], bool],
        refused: Callable[[list[float]], object],
        qos: Qos | int,
    ) -> int:
        """Subscribe, and notify the observers of whole messages."""

        def take(message: Any) -> None:
            numbers = [float(reduce(getitem, field.split("."), message)) for field in fields]
            if not target(numbers):
                refused(numbers)

        return self.subscribe(topic, message_type, take, qos, TimeForm.FLOAT)
