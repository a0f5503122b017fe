# SPDX-License-Identifier: BSD-3-Clause
"""`simROS` functions for topics."""

from __future__ import annotations

import sys
from collections.abc import Callable
from typing import Any

from bubblesim import _core
from bubblesim.program.output import write_line
from bubblesim.scripting.api.checked_calls import checked_on_failure
from bubblesim.scripting.api.ros.context import RosContext, with_slashes
from bubblesim.scripting.api.ros.kinds import RosHandle
from bubblesim.scripting.api.ros.stamps import Message, stamps
from bubblesim.scripting.caller import Caller

_CLOCK_TOLERANCE = 1.0  # s
_CHECK_INTERVAL = 1.0  # s of simulation time

Callback = Callable[[dict[str, Any]], object] | str


class RosTopics(RosContext):
    """Publishers and subscribers of one script; they are shut down when the script ends."""

    def __init__(self, bridge: Any, simulation: Any, caller: Caller) -> None:
        """Bind the functions to one script."""
        super().__init__(bridge, simulation, caller)
        self._topics: dict[int, str] = {}  # by publisher
        self._checked: set[int] = set()  # publishers with a recently checked message
        self._first_checked: set[int] = set()  # publishers with at least one checked message
        self._next_checks = 0.0  # simulation time

    @checked_on_failure
    def publish(self, publisher: RosHandle, message: Message) -> None:
        """Publish a message given as a dict; omitted fields have their defaults.

        Floats in integer fields are truncated toward zero, with one warning per field.
        """
        if publisher not in self._checked:
            self._check(publisher, message)
        truncations = self._bridge.publish(publisher, message)
        if truncations is not None:
            self._warn_of_truncation(f"'{self._topics[publisher]}'", truncations)

    def wantsMessages(self, publisher: RosHandle) -> bool:
        """Return whether the topic has subscribers; always true for a topic that keeps messages for late ones."""
        return bool(self._bridge.wants_messages(publisher))

    def shutdownPublisher(self, publisher: RosHandle) -> None:
        """Shut down a publisher; its handle becomes invalid."""
        self._bridge.shutdown_publisher(publisher)
        self._topics.pop(publisher, None)
        self._checked.discard(publisher)
        self._first_checked.discard(publisher)
        self._caller.at_end.pop(("publisher", publisher), None)

    def publisherTreatUInt8ArrayAsString(self, publisher: RosHandle) -> None:
        """Return at once; for older scripts: publish takes strings, bytes and tables for uint8[]."""

    def subscriberTreatUInt8ArrayAsString(self, subscriber: RosHandle) -> None:
        """Let uint8[] of received messages be strings in Lua, not tables; in Python they are always bytes."""
        self._byte_arrays.deliver_strings(subscriber)

    def _advertise(self, topic: str, message_type: str, qos: _core.Qos | int) -> int:
        message_type = with_slashes(message_type)
        publisher = int(self._bridge.advertise(topic, message_type, qos))
        self._caller.at_end["publisher", publisher] = lambda: self._bridge.shutdown_publisher(publisher)
        self._topics[publisher] = topic
        self._caller.in_each_step["checks of messages"] = self._renew_checks
        return publisher

    def _check(self, publisher: int, message: Message) -> None:
        """Check a message also without subscribers.

        Messages are converted only for subscribers. To report errors early, the first message is checked, and then one
        per second.
        """
        truncations = self._bridge.check(publisher, message)
        self._checked.add(publisher)
        self._warn_of_truncation(f"'{self._topics[publisher]}'", truncations)
        if publisher not in self._first_checked:
            self._first_checked.add(publisher)
            self._warn_of_another_clock(self._topics[publisher], message)

    def _renew_checks(self) -> None:
        if self._simulation.time >= self._next_checks:
            self._next_checks = self._simulation.time + _CHECK_INTERVAL
            self._checked.clear()

    def _subscribe(
        self,
        topic: str,
        message_type: str,
        guarded: Callable[[dict[str, Any]], None],
        qos: _core.Qos | int,
        *,
        for_script: bool = False,
    ) -> int:
        """Subscribe; ``for_script``: the script gets the messages as they are."""
        message_type = with_slashes(message_type)

        def deliver(message: dict[str, Any]) -> None:
            guarded(self._byte_arrays.received(subscriber, message))

        callback = deliver if for_script and self._caller.in_lua else guarded
        subscriber = int(self._bridge.subscribe(topic, message_type, callback, qos, self._time_form))
        self._caller.at_end["subscriber", subscriber] = lambda: self._bridge.shutdown_subscriber(subscriber)
        return subscriber

    def _shutdown_subscriber(self, subscriber: int) -> None:
        self._bridge.shutdown_subscriber(subscriber)
        self._byte_arrays.forget(subscriber)
        self._caller.at_end.pop(("subscriber", subscriber), None)

    def _warn_of_another_clock(self, topic: str, message: Message) -> None:
        """Warn about stamps of a clock that starts at 0, because tf and RViz drop such messages silently."""
        sec, nanosec = self._bridge.now()
        for stamp in stamps(message):
            ahead = stamp - (sec + nanosec * 1e-9)
            # Stamp 0 means no stamp; a static transform is valid at any time.
            if stamp == 0.0 or abs(ahead) <= _CLOCK_TOLERANCE or topic == "/tf_static":
                continue
            write_line(
                sys.stderr,
                f"warning: child script of {self._caller.object_path}: the first message on '{topic}' is stamped "
                f"{abs(ahead):.3g} s {'after' if ahead > 0 else 'before'} ROS time; "
                f"stamp with {self._module}.getTime()",
            )
            return
