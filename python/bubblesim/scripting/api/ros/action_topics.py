# SPDX-License-Identifier: BSD-3-Clause
"""The topics of an action in actionlib: NAME/goal, cancel, status, feedback and result."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import ExitStack, contextmanager
from enum import IntEnum
from typing import Any

from bubblesim import _core
from bubblesim.messages.names import did_you_mean, nearest_names, type_name
from bubblesim.scripting.api.ros.stamps import Message, now

GOAL_ID = "actionlib_msgs/GoalID"
STATUS_ARRAY = "actionlib_msgs/GoalStatusArray"

_QUEUE_SIZE = 100
_TIME_FORM = _core.messages.TimeForm.SEC_NANOSEC


class GoalStatus(IntEnum):
    """The constants of actionlib_msgs/GoalStatus."""

    PENDING = 0
    ACTIVE = 1
    PREEMPTED = 2
    SUCCEEDED = 3
    ABORTED = 4
    REJECTED = 5
    PREEMPTING = 6
    RECALLING = 7
    RECALLED = 8
    LOST = 9


class ActionTopics:
    """The publishers and subscribers of one action client or server."""

    def __init__(self, bridge: Any, name: str, action_type: str, note_truncations: Callable[[str, Any], None]) -> None:
        """Create no topics yet; raise MessageError if the type is unknown.

        :param note_truncations: called with the result of ``check``, and the action's name in quotes.
        """
        self.name = name
        self.closed = False
        self._type = _known_type(action_type)
        self._bridge = bridge
        self._note_truncations = note_truncations
        self._opened = ExitStack()
        self._publishers: list[int] = []
        self._subscribers: list[int] = []

    @contextmanager
    def closed_on_error(self) -> Iterator[None]:
        """Close all topics if the block fails."""
        try:
            yield
        except BaseException:
            self.close()
            raise

    def close(self) -> None:
        """Shut down all topics."""
        self.closed = True
        self._opened.close()

    def message_type(self, part: str) -> str:
        """Return the type of the message with a "Goal", "Feedback" or "Result" of this action."""
        return f"{self._type}Action{part}"

    def default_result(self) -> dict[str, Any]:
        """Return a result with all fields at their defaults."""
        result: dict[str, Any] = _core.messages.default(self.message_type("Result"), _TIME_FORM)["result"]
        return result

    def advertise(self, topic: str, message_type: str, *, latch: bool = False) -> int:
        """Create a publisher on NAME/``topic``."""
        qos = _core.Qos(_QUEUE_SIZE, transient_local=latch)
        publisher = int(self._bridge.advertise(f"{self.name}/{topic}", message_type, qos))
        self._opened.callback(self._bridge.shutdown_publisher, publisher)
        self._publishers.append(publisher)
        return publisher

    def subscribe(self, topic: str, message_type: str, callback: Callable[[dict[str, Any]], None]) -> None:
        """Call ``callback`` with each message on NAME/``topic``."""
        subscriber = self._bridge.subscribe(f"{self.name}/{topic}", message_type, callback, _QUEUE_SIZE, _TIME_FORM)
        self._opened.callback(self._bridge.shutdown_subscriber, subscriber)
        self._subscribers.append(subscriber)

    def are_connected(self) -> bool:
        """Return whether every topic is connected to another node."""
        return all(map(self._bridge.wants_messages, self._publishers)) and all(
            map(self._bridge.has_publisher, self._subscribers)
        )

    def check(self, publisher: int, message: Message) -> None:
        """Raise the MessageError of a message that cannot be published, also without subscribers."""
        self._note_truncations(f"'{self.name}'", self._bridge.check(publisher, message))

    def publish(self, publisher: int, message: Message) -> None:
        """Publish a message."""
        self._bridge.publish(publisher, message)

    def now(self) -> dict[str, int]:
        """Return ROS time, for stamps."""
        return now(self._bridge)


def _known_type(given: str) -> str:
    """Return `actionlib/Test`, also for `actionlib/action/Test`, if its messages exist."""
    name = type_name(given.replace("/action/", "/"))
    known = _core.messages.message_names()
    if name is not None and f"{name}ActionGoal" in known:
        return name
    # Imported here because it needs the ROS installation, which simulations without ROS do not have.
    from bubblesim.messages.packages import machine_index

    index = machine_index()
    if name is not None and index.find(f"{name}ActionGoal", "msg") is not None:
        return name
    goals = [each for each in (*known, *index.names("msg")) if each.endswith("ActionGoal")]
    actions = sorted({each.removesuffix("ActionGoal") for each in goals})
    raise _core.MessageError(
        f"'{given}' is not an action type of this build or machine, expected package/Name such as actionlib/Test with "
        f"the messages NameActionGoal, NameActionFeedback and NameActionResult"
        + did_you_mean(nearest_names(name or given, actions))
    )
