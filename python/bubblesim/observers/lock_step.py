# SPDX-License-Identifier: BSD-3-Clause
"""Lockstep with a controller: each step waits for the response to the previous one, independent of real time."""

from __future__ import annotations

import sys
import time
from typing import Any

from bubblesim._core import RunState
from bubblesim.program.output import write_line

_TIMEOUT = 5.0  # s
# Before the first step, the connections must be unchanged for this time: a node that advertises first may still be
# about to subscribe.
_SETTLING_TIME = 0.4
# A node on simulated time also subscribes to /clock, and may detect a timeout if its first clock message is late.
# Without a subscriber of /clock, wait longer for one.
_SETTLING_TIME_WITHOUT_CLOCK = 2.0
BEFORE_THE_CONTROLLER = "lockstep waits before the second step for a controller"
"""How the reason begins while no controller is connected."""


class LockStep:
    """An observer of a bridge. A step is complete when a message has been received on each topic since its end.

    Scripts create their topics in the first step. Before the second, a publisher of each topic must be connected, a
    subscriber of a topic that scripts publish, and one of /clock. What scripts publish before that reaches no node,
    because it would depend on the speed of the connections which messages a controller gets.
    """

    def __init__(self, topics: list[str], bridge: Any, runner: Any) -> None:
        """Make the steps of the runner wait."""
        self._topics = {topic if topic.startswith("/") else f"/{topic}" for topic in topics}
        self._bridge = bridge
        self._runner = runner
        self._simulation = runner.simulation
        self._subscribers: dict[str, int] = {}  # by topic
        self._publishers: list[int] = []  # of all topics
        self.connected = False  # since the last start of a script
        self._started = False
        self._pending: set[str] = set()
        self._since = time.monotonic()
        self._warned = False
        self._connections: object = None
        self._settled_at = 0.0
        runner.add_gate(self.is_ready, self.timeout_reason)

    def advertised(self, publisher: int) -> None:
        """Store the publisher, whose subscribers are checked before the second step."""
        self._publishers.append(publisher)

    def subscribed(self, topic: str, subscriber: int) -> None:
        """Wait for the connections again: a script has started."""
        if topic in self._topics:
            self._subscribers[topic] = subscriber
            self.connected = False
            self._restart(started=False)

    def published(self, topic: str, message_type: str, message: Any) -> None:
        """Do nothing."""

    def received(self, topic: str, message_type: str, message: Any) -> None:
        """Mark the topic as received."""
        self._pending.discard(topic)

    def input_processed(self) -> None:
        """Warn once if the next step waits for too long."""
        if self._warned or self._runner.state != RunState.RUNNING or time.monotonic() - self._since <= _TIMEOUT:
            return
        if not self.is_ready():
            self._warned = True
            write_line(sys.stderr, f"warning: {self.timeout_reason()}")

    def step_done(self) -> None:
        """Wait for new messages from now on."""
        self._restart(started=self._simulation.time > 0.0)

    def close(self) -> None:
        """Do nothing."""

    def is_ready(self) -> bool:
        """Return whether the next step may start."""
        if self._simulation.time == 0.0:
            return True  # scripts create their topics in the first step
        if not self.connected:
            self.connected = self._connections_have_settled()
        return self.connected and not (self._started and self._pending)

    def timeout_reason(self) -> str:
        """Return which messages are missing, and the likely reason."""
        unsubscribed = self._topics - self._subscribers.keys()
        if unsubscribed:
            return f"lockstep waits: no script subscribes to {_joined(unsubscribed)}, given by --lockstep"
        if not self._started:
            return (
                f"{BEFORE_THE_CONTROLLER} that publishes {_joined(self._topics)} and "
                "subscribes to a topic of the scripts: is it running, with this master?"
            )
        missing = {topic for topic in self._pending if not self._bridge.has_publisher(self._subscribers[topic])}
        why = "it has no publisher any more" if missing else "its publisher does not publish in each step"
        return (
            f"lockstep waits at {self._simulation.time:.3f} s: no message on {_joined(missing or self._pending)} "
            f"for {_TIMEOUT:g} s: {why}"
        )

    def _restart(self, *, started: bool) -> None:
        self._started = started
        self._pending = set(self._topics)
        self._since = time.monotonic()
        self._warned = False

    def _connections_have_settled(self) -> bool:
        received = {topic: self._bridge.has_publisher(id_) for topic, id_ in self._subscribers.items()}
        subscribed_to = [self._has_subscribers(publisher) for publisher in self._publishers]
        if self._topics - received.keys() or not all(received.values()) or not any(subscribed_to):
            return False
        clock = self._bridge.clock_reaches_others()
        connections = received, subscribed_to, clock
        now = time.monotonic()
        if connections != self._connections:
            self._connections, self._settled_at = connections, now
        return now - self._settled_at >= (_SETTLING_TIME if clock else _SETTLING_TIME_WITHOUT_CLOCK)

    def _has_subscribers(self, publisher: int) -> bool:
        try:
            return bool(self._bridge.wants_messages(publisher))
        except ValueError:  # shut down
            return False


def _joined(topics: set[str]) -> str:
    return " and ".join(sorted(topics))
