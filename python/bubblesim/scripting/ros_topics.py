# SPDX-License-Identifier: BSD-3-Clause
"""`simROS` functions about topics and transforms."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from typing import TYPE_CHECKING, Any

from bubblesim.scripting.ros_context import RosContext

if TYPE_CHECKING:
    from bubblesim.scripting.child_script import ChildScript

Message = Mapping[str, Any]
Callback = Callable[[dict[str, Any]], object] | str

_TF_QUEUE_SIZE = 100


class RosTopics(RosContext):
    """Publishers and subscribers of one script; they are shut down when the script ends."""

    def __init__(self, bridge: Any, simulation: Any, script: ChildScript) -> None:
        """Bind the functions to one script."""
        super().__init__(bridge, simulation, script)
        self._tf_publisher: int | None = None
        self._unchecked: set[int] = set()  # publishers that have published nothing yet

    def publish(self, publisher: int, message: Message) -> None:
        """Publish a message given as a dict; fields left out have their defaults."""
        if publisher in self._unchecked:
            # Messages are converted only while somebody listens. A first message that is wrong should be told at
            # once, not when somebody listens at last.
            self._bridge.check(publisher, message)
            self._unchecked.discard(publisher)
        self._bridge.publish(publisher, message)

    def sendTransform(self, transform: Message) -> None:
        """Send a geometry_msgs/TransformStamped on /tf."""
        self.sendTransforms([transform])

    def sendTransforms(self, transforms: Iterable[Message]) -> None:
        """Send several transforms in one message."""
        if self._tf_publisher is None:
            self._tf_publisher = self._advertise("/tf", "tf2_msgs/TFMessage", _TF_QUEUE_SIZE, latch=False)
        self.publish(self._tf_publisher, {"transforms": list(transforms)})

    def shutdownPublisher(self, publisher: int) -> None:
        """Stop publishing; the handle cannot be used any more."""
        self._bridge.shutdown_publisher(publisher)
        self._script.at_end.pop(("publisher", publisher), None)

    def publisherTreatUInt8ArrayAsString(self, publisher: int) -> None:
        """Accepted for older scripts: uint8[] takes and gives bytes in any case."""

    def subscriberTreatUInt8ArrayAsString(self, subscriber: int) -> None:
        """Accepted for older scripts: uint8[] takes and gives bytes in any case."""

    def _advertise(self, topic: str, message_type: str, queue_size: int, *, latch: bool) -> int:
        publisher = int(self._bridge.advertise(topic, message_type, queue_size, latch))
        self._script.at_end["publisher", publisher] = lambda: self._bridge.shutdown_publisher(publisher)
        self._unchecked.add(publisher)
        return publisher

    def _subscribe(self, topic: str, message_type: str, callback: Callback, queue_size: int) -> int:
        guarded = self._script.callback(callback)
        subscriber = int(self._bridge.subscribe(topic, message_type, guarded, queue_size, self._time_form))
        self._script.at_end["subscriber", subscriber] = lambda: self._bridge.shutdown_subscriber(subscriber)
        return subscriber

    def _shutdown_subscriber(self, subscriber: int) -> None:
        self._bridge.shutdown_subscriber(subscriber)
        self._script.at_end.pop(("subscriber", subscriber), None)
