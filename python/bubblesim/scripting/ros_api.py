# SPDX-License-Identifier: BSD-3-Clause
"""The modules `simROS` and `simROS2` as one child script sees them: the same bridge under two sets of names."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from typing import TYPE_CHECKING, Any

from bubblesim import _core

if TYPE_CHECKING:
    from bubblesim.scripting.child_script import ChildScript

Message = Mapping[str, Any]
Callback = Callable[[dict[str, Any]], object] | str

_TF_QUEUE_SIZE = 100


class RosTopics:
    """Publishers and subscribers of one script; they are shut down when the script ends."""

    _time_form = _core.messages.TimeForm.FLOAT

    def __init__(self, bridge: Any, simulation: Any, script: ChildScript) -> None:
        """Bind the functions to one script."""
        self._bridge = bridge
        self._simulation = simulation
        self._script = script
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


class SimRos(RosTopics):
    """`simROS`: times in messages are float seconds."""

    def advertise(self, topic: str, message_type: str, queue_size: int = 1, latch: bool = False) -> int:
        """Make a publisher and return its handle."""
        return self._advertise(topic, message_type, queue_size, latch=latch)

    def subscribe(
        self,
        topic: str,
        message_type: str,
        callback: Callback,
        queue_size: int = 1,
        transport_hints: object = None,
    ) -> int:
        """Call ``callback`` (a function or the name of one) with each message as a dict; return a handle."""
        return self._subscribe(topic, message_type, callback, queue_size)

    def shutdownSubscriber(self, subscriber: int) -> None:
        """Stop listening; the handle cannot be used any more."""
        self._shutdown_subscriber(subscriber)

    def getTime(self, flag: int = 0) -> float:
        """ROS time in seconds: the simulation's under /use_sim_time, else the wall clock's."""
        sec, nanosec = self._bridge.now()
        return float(sec + nanosec * 1e-9)


class SimRos2(RosTopics):
    """`simROS2`: the names of the ROS 2 tutorials; times in messages are {sec, nanosec}."""

    _time_form = _core.messages.TimeForm.SEC_NANOSEC

    def createPublisher(self, topic: str, message_type: str, queue_size: int = 1, latch: bool = False) -> int:
        """Make a publisher and return its handle."""
        return self._advertise(topic, message_type, queue_size, latch=latch)

    def createSubscription(self, topic: str, message_type: str, callback: Callback, queue_size: int = 1) -> int:
        """Call ``callback`` (a function or the name of one) with each message as a dict; return a handle."""
        return self._subscribe(topic, message_type, callback, queue_size)

    def shutdownSubscription(self, subscriber: int) -> None:
        """Stop listening; the handle cannot be used any more."""
        self._shutdown_subscriber(subscriber)

    def getTime(self) -> dict[str, int]:
        """ROS time as {sec, nanosec}."""
        sec, nanosec = self._bridge.now()
        return {"sec": sec, "nanosec": nanosec}

    def getSystemTime(self) -> dict[str, int]:
        """ROS time as {sec, nanosec}."""
        return self.getTime()

    def getSimulationTime(self) -> dict[str, int]:
        """Simulation time as {sec, nanosec}."""
        nanoseconds = round(self._simulation.time * 1e9)
        return {"sec": nanoseconds // 1_000_000_000, "nanosec": nanoseconds % 1_000_000_000}
