# SPDX-License-Identifier: BSD-3-Clause
"""`simROS` functions about topics."""

from __future__ import annotations

import sys
from collections.abc import Callable
from typing import TYPE_CHECKING, Any

from bubblesim.scripting.api import checked_on_failure
from bubblesim.scripting.output import write_line
from bubblesim.scripting.ros_context import RosContext
from bubblesim.scripting.ros_kinds import RosHandle
from bubblesim.scripting.ros_stamps import Message, stamps

if TYPE_CHECKING:
    from bubblesim.scripting.child_script import ChildScript

_CLOCK_TOLERANCE = 1.0  # s

Callback = Callable[[dict[str, Any]], object] | str


class RosTopics(RosContext):
    """Publishers and subscribers of one script; they are shut down when the script ends."""

    def __init__(self, bridge: Any, simulation: Any, script: ChildScript) -> None:
        """Bind the functions to one script."""
        super().__init__(bridge, simulation, script)
        self._unchecked: dict[int, str] = {}  # topics of publishers that have published nothing yet

    @checked_on_failure
    def publish(self, publisher: RosHandle, message: Message) -> None:
        """Publish a message given as a dict; fields left out have their defaults."""
        if publisher in self._unchecked:
            # Messages are converted only while somebody listens. A first message that is wrong should be told at
            # once, not when somebody listens at last.
            self._bridge.check(publisher, message)
            self._warn_of_another_clock(self._unchecked.pop(publisher), message)
        self._bridge.publish(publisher, message)

    def wantsMessages(self, publisher: RosHandle) -> bool:
        """Whether somebody listens, so that a message is worth making; always for a latched topic."""
        return bool(self._bridge.wants_messages(publisher))

    def shutdownPublisher(self, publisher: RosHandle) -> None:
        """Stop publishing; the handle cannot be used any more."""
        self._bridge.shutdown_publisher(publisher)
        self._unchecked.pop(publisher, None)
        self._script.at_end.pop(("publisher", publisher), None)

    def publisherTreatUInt8ArrayAsString(self, publisher: RosHandle) -> None:
        """Accepted for older scripts: uint8[] takes and gives bytes in any case."""

    def subscriberTreatUInt8ArrayAsString(self, subscriber: RosHandle) -> None:
        """Accepted for older scripts: uint8[] takes and gives bytes in any case."""

    def _advertise(self, topic: str, message_type: str, queue_size: int, *, latch: bool) -> int:
        publisher = int(self._bridge.advertise(topic, message_type, queue_size, latch))
        self._script.at_end["publisher", publisher] = lambda: self._bridge.shutdown_publisher(publisher)
        self._unchecked[publisher] = topic
        return publisher

    def _listen(
        self,
        topic: str,
        message_type: str,
        guarded: Callable[[dict[str, Any]], None],
        queue_size: int,
        *,
        tcp_no_delay: bool = True,
    ) -> int:
        subscriber = int(
            self._bridge.subscribe(topic, message_type, guarded, queue_size, self._time_form, tcp_no_delay)
        )
        self._script.at_end["subscriber", subscriber] = lambda: self._bridge.shutdown_subscriber(subscriber)
        return subscriber

    def _shutdown_subscriber(self, subscriber: int) -> None:
        self._bridge.shutdown_subscriber(subscriber)
        self._script.at_end.pop(("subscriber", subscriber), None)

    def _warn_of_another_clock(self, topic: str, message: Message) -> None:
        """Scripts like to stamp with a clock that starts at 0, and then tf and RViz drop all of it in silence."""
        sec, nanosec = self._bridge.now()
        for stamp in stamps(message):
            ahead = stamp - (sec + nanosec * 1e-9)
            # Time 0 is that of a message without a stamp; a static transform holds at any time.
            if stamp == 0.0 or abs(ahead) <= _CLOCK_TOLERANCE or topic == "/tf_static":
                continue
            write_line(
                sys.stderr,
                f"warning: child script of {self._script.object_path}: the first message on '{topic}' is stamped "
                f"{abs(ahead):.3g} s {'after' if ahead > 0 else 'before'} ROS time and sent as it is; "
                f"stamp with {self._module}.getTime()",
            )
            return
