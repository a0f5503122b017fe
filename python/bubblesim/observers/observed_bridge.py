# SPDX-License-Identifier: BSD-3-Clause
"""A bridge that tells others which messages go through it: for bags, and for lockstep with a controller."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any, Protocol


class Observer(Protocol):
    """Told of what scripts do with topics."""

    def advertised(self, publisher: int) -> None:
        """A script has made a publisher."""

    def subscribed(self, topic: str, subscriber: int) -> None:
        """A script listens."""

    def published(self, topic: str, message_type: str, message: Any) -> None:
        """A script has published."""

    def heard(self, topic: str, message_type: str, message: Any) -> None:
        """A message has come, which the script has not seen yet."""

    def input_processed(self) -> None:
        """All that has come was delivered; often, also while nothing runs."""

    def pass_done(self) -> None:
        """A step is over."""

    def close(self) -> None:
        """There will be nothing more."""


class ObservedBridge:
    """As the bridge that it stands before; see ``bubblesim._core.Bridge``."""

    def __init__(self, bridge: Any, observers: list[Observer], *, keeps_all: bool = False) -> None:
        """Nothing was published yet.

        :param keeps_all: also what nobody hears is of use.
        """
        self.observers = observers
        self.keeps_all = keeps_all
        self._bridge = bridge
        self._published: dict[int, tuple[str, str]] = {}  # topic and type by publisher

    def __getattr__(self, name: str) -> Any:
        """All that is not observed."""
        return getattr(self._bridge, name)

    def advertise(self, topic: str, message_type: str, queue_size: int, latch: bool) -> int:
        """Make a publisher."""
        publisher: int = self._bridge.advertise(topic, message_type, queue_size, latch)
        self._published[publisher] = topic, message_type
        for observer in self.observers:
            observer.advertised(publisher)
        return publisher

    def publish(self, publisher: int, message: Any) -> Any:
        """Publish, and tell of it."""
        truncations = self._bridge.publish(publisher, message)
        for observer in self.observers:
            observer.published(*self._published[publisher], message)
        return truncations

    def subscribe(
        self, topic: str, message_type: str, callback: Callable[[Any], object], *arguments: Any, **named: Any
    ) -> int:
        """Listen, and tell of what comes."""

        def deliver(message: Any) -> None:
            for observer in self.observers:
                observer.heard(topic, message_type, message)
            callback(message)

        subscriber: int = self._bridge.subscribe(topic, message_type, deliver, *arguments, **named)
        for observer in self.observers:
            observer.subscribed(topic, subscriber)
        return subscriber


def observed(bridge: Any, simulation: Any, record: str, lockstep: list[str]) -> ObservedBridge:
    """The bridge with the observers that the node's options ask for.

    :param record: file of the bag to write; empty: none.
    :param lockstep: topics that each step waits for; see LockStep.
    """
    from bubblesim.observers.bag_recorder import BagRecorder
    from bubblesim.observers.lock_step import LockStep

    observers: list[Observer] = []
    if record:
        observers.append(BagRecorder(Path(record), bridge))
    if lockstep:
        observers.append(LockStep(lockstep, bridge, simulation))
    return ObservedBridge(bridge, observers, keeps_all=bool(record))
