# SPDX-License-Identifier: BSD-3-Clause
"""The topics of an action in actionlib: NAME/goal, cancel, status, feedback and result."""

from __future__ import annotations

from collections.abc import Callable
from enum import IntEnum
from typing import Any

from bubblesim import _core
from bubblesim.messages.names import did_you_mean, nearest_names, type_name
from bubblesim.scripting.api.ros.action_endpoints import QUEUE_SIZE, TIME_FORM, ActionEndpoints

GOAL_ID = "actionlib_msgs/GoalID"
STATUS_ARRAY = "actionlib_msgs/GoalStatusArray"


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


class ActionTopics(ActionEndpoints):
    """The publishers and subscribers of one action client or server."""

    def __init__(self, bridge: Any, name: str, action_type: str, note_truncations: Callable[[str, Any], None]) -> None:
        """Create no topics yet; raise MessageError if the type is unknown."""
        super().__init__(bridge, name, name, note_truncations)
        self._type = _known_type(action_type)
        self._publishers: list[int] = []
        self._subscribers: list[int] = []

    def message_type(self, part: str) -> str:
        """Return the type of the message with a "Goal", "Feedback" or "Result" of this action."""
        return f"{self._type}Action{part}"

    def default_result(self) -> dict[str, Any]:
        """Return a result with all fields at their defaults."""
        result: dict[str, Any] = _core.messages.default(self.message_type("Result"), TIME_FORM)["result"]
        return result

    def advertise(self, topic: str, message_type: str, qos: _core.Qos | int = QUEUE_SIZE) -> int:
        """Create a publisher on NAME/``topic``."""
        self._publishers.append(super().advertise(topic, message_type, qos))
        return self._publishers[-1]

    def subscribe(self, topic: str, message_type: str, callback: Callable[[dict[str, Any]], None]) -> int:
        """Call ``callback`` with each message on NAME/``topic``."""
        self._subscribers.append(super().subscribe(topic, message_type, callback))
        return self._subscribers[-1]

    def are_connected(self) -> bool:
        """Return whether every topic is connected to another node."""
        return all(map(self.bridge.wants_messages, self._publishers)) and all(
            map(self.bridge.has_publisher, self._subscribers)
        )


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
