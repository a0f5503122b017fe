# SPDX-License-Identifier: BSD-3-Clause
"""The topics and services of an action in ROS 2: NAME/_action/send_goal, cancel_goal, get_result, feedback, status."""

from __future__ import annotations

import uuid
from collections.abc import Callable, Iterator
from contextlib import ExitStack, contextmanager
from enum import IntEnum
from typing import Any

from bubblesim import _core
from bubblesim.scripting.api.ros.stamps import Message, now

TIME_FORM = _core.messages.TimeForm.SEC_NANOSEC
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


class Ros2ActionParts:
    """The endpoints of one action client or server."""

    def __init__(self, bridge: Any, name: str, action_type: str) -> None:
        """Create none yet; raise MessageError if the type is unknown."""
        # Imported here because it needs the ROS installation, which simulations without ROS do not have.
        from bubblesim.messages.runtime import add_action

        self.name = name
        self.closed = False
        self.bridge = bridge
        self._type = add_action(action_type)
        self._opened = ExitStack()

    @contextmanager
    def closed_on_error(self) -> Iterator[None]:
        """Close all endpoints if the block fails."""
        try:
            yield
        except BaseException:
            self.close()
            raise

    def close(self) -> None:
        """Shut down all endpoints."""
        self.closed = True
        self._opened.close()

    def service_type(self, part: str) -> str:
        """Return the type of "send_goal", "get_result" or "cancel_goal"."""
        return {"send_goal": f"{self._type}_SendGoal", "get_result": f"{self._type}_GetResult"}.get(part, _CANCEL)

    @property
    def feedback_type(self) -> str:
        """Return the type of the messages with feedback."""
        return f"{self._type}_FeedbackMessage"

    def advertise(self, topic: str, message_type: str, qos: _core.Qos | int) -> int:
        """Create a publisher."""
        publisher = int(self.bridge.advertise(f"{self.name}/_action/{topic}", message_type, qos))
        self._opened.callback(self.bridge.shutdown_publisher, publisher)
        return publisher

    def subscribe(self, topic: str, message_type: str, callback: Callable[[dict[str, Any]], None]) -> int:
        """Call ``callback`` with each message."""
        subscriber = int(self.bridge.subscribe(f"{self.name}/_action/{topic}", message_type, callback, 100, TIME_FORM))
        self._opened.callback(self.bridge.shutdown_subscriber, subscriber)
        return subscriber

    def serve(self, part: str, callback: Callable[[int, dict[str, Any]], None]) -> int:
        """Call ``callback`` with the number of each request and its fields."""
        name = f"{self.name}/_action/{part}"
        server = int(self.bridge.advertise_service_later(name, self.service_type(part), callback, TIME_FORM))
        self._opened.callback(self.bridge.shutdown_service_server, server)
        return server

    def client(self, part: str) -> int:
        """Create a client of a service."""
        client = int(self.bridge.service_client(f"{self.name}/_action/{part}", self.service_type(part)))
        self._opened.callback(self.bridge.shutdown_service_client, client)
        return client

    def check_goal(self, goal: Message) -> None:
        """Raise the MessageError of a goal that cannot be sent."""
        _core.messages.encode_ros2(f"{self._type}_Goal", goal)

    def check_result(self, result: Message) -> None:
        """Raise the MessageError of a result that cannot be sent."""
        _core.messages.encode_ros2(f"{self._type}_Result", result)

    def default_result(self) -> dict[str, Any]:
        """Return a result with all fields at their defaults."""
        result: dict[str, Any] = _core.messages.default(f"{self._type}_Result", TIME_FORM, _ROS2)
        return result

    def now(self) -> dict[str, int]:
        """Return ROS time, for stamps."""
        return now(self.bridge)
