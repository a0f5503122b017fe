# SPDX-License-Identifier: BSD-3-Clause
"""Passes in step with a controller: each waits for the answer to the last one, however quick the machine is."""

from __future__ import annotations

import sys
import time
from typing import Any

from bubblesim._core import RunState
from bubblesim.output import write_line

_LATE = 5.0  # s
# For so long nothing may have changed among the connections before the first step: who makes its publishers first may
# still be about to subscribe.
_SETTLED = 0.4
# A node on simulated time listens to /clock, too, and may take it for silence when the first that it hears is late. One
# that does not care for the time is waited for longer, in case it does.
_SETTLED_WITHOUT_CLOCK = 2.0
_POLL = 0.0002  # s


class LockStep:
    """An observer of a bridge. A step is answered when each of the topics has brought a message since it ended.

    In the very first step scripts make their topics. Before the next one a publisher of each topic must be connected,
    a subscriber of something that scripts publish, and one of /clock.
    """

    def __init__(self, topics: list[str], bridge: Any, simulation: Any) -> None:
        """Make the simulation wait for triggers."""
        self._topics = {topic if topic.startswith("/") else f"/{topic}" for topic in topics}
        self._bridge = bridge
        self._simulation = simulation
        self._subscribers: dict[str, int] = {}  # of the topics
        self._publishers: list[int] = []  # of any
        self._began = False
        self._awaited: set[str] = set()
        self._since = time.monotonic()
        self._triggered = False
        self._warned = False
        self._connections: object = None
        self._settled_at = 0.0
        simulation.set_synchronous(True)

    def advertised(self, publisher: int) -> None:
        """Somebody may listen, and answer."""
        self._publishers.append(publisher)

    def subscribed(self, topic: str, subscriber: int) -> None:
        """A script has started: first somebody must be connected."""
        if topic in self._topics:
            self._subscribers[topic] = subscriber
            self._restart(began=False)

    def published(self, topic: str, message_type: str, message: Any) -> None:
        """Nothing to wait for."""

    def heard(self, topic: str, message_type: str, message: Any) -> None:
        """Perhaps an answer."""
        self._awaited.discard(topic)

    def input_processed(self) -> None:
        """Let the next step come when it may, and complain when it waits for long."""
        if self._simulation.state != RunState.RUNNING or self._triggered:
            return
        if self.answered():
            self._triggered = True
            self._simulation.trigger_step()
        elif not self._warned and time.monotonic() - self._since > _LATE:
            self._warned = True
            write_line(sys.stderr, f"warning: {self.lateness()}")

    def pass_done(self) -> None:
        """From now on the answers count."""
        self._restart(began=self._simulation.time > 0.0)

    def close(self) -> None:
        """Nothing is left behind."""

    def answered(self) -> bool:
        """Whether the next step may come."""
        if self._simulation.time == 0.0:
            return True  # in which scripts make their topics
        if not self._began:
            return self._connected()
        return not self._awaited

    def wait(self) -> str:
        """Wait for the answers; why they did not come in time, or nothing. Only where messages may be delivered."""
        end = time.monotonic() + _LATE
        while not self.answered():
            if time.monotonic() > end:
                return self.lateness()
            time.sleep(_POLL)
            self._bridge.process_input()
        return ""

    def lateness(self) -> str:
        """What is missing, and why that may be."""
        unheard = self._topics - self._subscribers.keys()
        if unheard:
            return f"no step comes, for no script subscribes to {_listed(unheard)}, which --lockstep names"
        if not self._began:
            return (
                f"the second step waits for a controller that publishes {_listed(self._topics)} and subscribes to what "
                "scripts publish: does it run, on this master?"
            )
        missing = {topic for topic in self._awaited if not self._bridge.has_publisher(self._subscribers[topic])}
        why = "nobody publishes it any more" if missing else "its publisher is there, but does not answer each step"
        return (
            f"the step before {self._simulation.time:.3f} s has had no answer on {_listed(missing or self._awaited)} "
            f"for {_LATE:g} s: {why}"
        )

    def _restart(self, *, began: bool) -> None:
        self._began = began
        self._awaited = set(self._topics)
        self._since = time.monotonic()
        self._triggered = self._warned = False

    def _connected(self) -> bool:
        heard = {topic: self._bridge.has_publisher(id_) for topic, id_ in self._subscribers.items()}
        listened = [self._wanted(publisher) for publisher in self._publishers]
        if self._topics - heard.keys() or not all(heard.values()) or not any(listened):
            return False
        clock = self._bridge.clock_reaches_others()
        connections = heard, listened, clock
        now = time.monotonic()
        if connections != self._connections:
            self._connections, self._settled_at = connections, now
        return now - self._settled_at >= (_SETTLED if clock else _SETTLED_WITHOUT_CLOCK)

    def _wanted(self, publisher: int) -> bool:
        try:
            return bool(self._bridge.wants_messages(publisher))
        except ValueError:  # shut down
            return False


def _listed(topics: set[str]) -> str:
    return " and ".join(sorted(topics))
