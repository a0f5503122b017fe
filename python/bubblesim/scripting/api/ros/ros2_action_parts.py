# SPDX-License-Identifier: BSD-3-Clause
"""The topics and services of an action in ROS 2: NAME/_action/send_goal, cancel_goal, get_result, feedback, status."""

from __future__ import annotations

import uuid
from collections.abc import Callable
from enum import IntEnum
from typing import Any

from bubblesim import _core
from bubblesim.scripting.api.ros.action_endpoints import TIME_FORM, ActionEndpoints
from bubblesim.scripting.api.ros.stamps import Message

_ROS2 = _core.messages.RosVersion.ROS2
STATUS_ARRAY = "action_msgs/GoalStatusArray"
_CANCEL = "action_msgs/CancelGoal"


class Status(IntEnum):
    """The constants of action_msgs/GoalStatus."""

    UNKNOWN = 0
    ACCEPTED = 1
    EXECUTING = 2
    CANCELING = 3
    SUCCEEDED = 4
    CANCELED = 5
    ABORTED = 6


def id_message(goal_id: str) -> Message:
    """Return a unique_identifier_msgs/UUID."""
    return {"uuid": uuid.UUID(goal_id).bytes}


def id_of(message: Message) -> str:
    """Return the id in a unique_identifier_msgs/UUID."""
    return str(uuid.UUID(bytes=bytes(message["uuid"])))


class Ros2ActionParts(ActionEndpoints):
    """The endpoints of one action client or server."""

    def __init__(self, bridge: Any, name: str, action_type: str, note_truncations: Callable[[str, Any], None]) -> None:
        """Create none yet; raise MessageError if the type is unknown."""
        # Imported here because it needs the ROS installation, which simulations without ROS do not have.
        from bubblesim.messages.runtime import add_action

        super().__init__(bridge, name, f"{name}/_action", note_truncations)
        self._type = add_action(action_type)

    def service_type(self, part: str) -> str:
        """Return the type of "send_goal", "get_result" or "cancel_goal"."""
        return {"send_goal": f"{self._type}_SendGoal", "get_result": f"{self._type}_GetResult"}.get(part, _CANCEL)

    @property
    def feedback_type(self) -> str:
        """Return the type of the messages with feedback."""
        return f"{self._type}_FeedbackMessage"

    def serve(self, part: str, callback: Callable[[int, dict[str, Any]], None]) -> int:
        """Call ``callback`` with the number of each request and its fields."""
        name = f"{self._prefix}/{part}"
        server = int(self.bridge.advertise_service_later(name, self.service_type(part), callback, TIME_FORM))
        self._opened.callback(self.bridge.shutdown_service_server, server)
        return server

    def client(self, part: str) -> int:
        """Create a client of a service."""
        client = int(self.bridge.service_client(f"{self._prefix}/{part}", self.service_type(part)))
        self._opened.callback(self.bridge.shutdown_service_client, client)
        return client

    def check_goal(self, goal: Message) -> None:
        """Raise the MessageError of a goal that cannot be sent."""
        self._check_part("Goal", goal)

    def check_result(self, result: Message) -> None:
        """Raise the MessageError of a result that cannot be sent."""
        self._check_part("Result", result)

    def default_result(self) -> dict[str, Any]:
        """Return a result with all fields at their defaults."""
        result: dict[str, Any] = _core.messages.default(f"{self._type}_Result", TIME_FORM, _ROS2)
        return result

    def _check_part(self, part: str, message: Message) -> None:
        self._note_truncations(f"'{self.name}'", _core.messages.truncations(f"{self._type}_{part}", message, _ROS2))
