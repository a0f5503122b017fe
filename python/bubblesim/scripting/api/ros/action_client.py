# SPDX-License-Identifier: BSD-3-Clause
"""Action client: sends goals and tracks their states."""

from __future__ import annotations

import copy
import uuid
from collections import deque
from collections.abc import Callable
from dataclasses import dataclass
from enum import IntEnum
from typing import Any

from bubblesim.scripting.api.ros.action_topics import GOAL_ID, STATUS_ARRAY, ActionTopics, GoalStatus
from bubblesim.scripting.api.ros.stamps import Message


class ResultCode(IntEnum):
    """Final state of a goal, with the values of ROS 2's action_msgs/GoalStatus."""

    UNKNOWN = 0  # the server does not know it any more
    SUCCEEDED = 4
    CANCELED = 5
    ABORTED = 6


_CODES: dict[int, ResultCode] = {
    GoalStatus.SUCCEEDED: ResultCode.SUCCEEDED,
    GoalStatus.PREEMPTED: ResultCode.CANCELED,
    GoalStatus.RECALLED: ResultCode.CANCELED,
    GoalStatus.ABORTED: ResultCode.ABORTED,
}
# A ROS 1 server may still reject a pending goal.
_UNDECIDED = (GoalStatus.PENDING, GoalStatus.RECALLING)
_REFUSED = (GoalStatus.REJECTED, GoalStatus.LOST)


@dataclass
class _Sent:
    seen: bool = False  # in the server's status
    answered: bool = False


class ActionClient:
    """Tracks its goals by actionlib's protocol; callbacks are called while pending input is processed."""

    def __init__(
        self,
        topics: ActionTopics,
        goal_response: Callable[[str, bool], None],
        feedback: Callable[[str, Message], None],
        result: Callable[[str, int, Message], None],
    ) -> None:
        """Create the topics."""
        self._topics = topics
        self._goal_response = goal_response
        self._feedback = feedback
        self._result = result
        self._goals: dict[str, _Sent] = {}  # goals that have not ended
        self._last_goal = ""
        self._outgoing: deque[tuple[int, Message]] = deque()  # publisher, message
        self._server_ready = False
        topics.subscribe("feedback", topics.message_type("Feedback"), self._on_feedback)
        topics.subscribe("result", topics.message_type("Result"), self._on_result)
        topics.subscribe("status", STATUS_ARRAY, self._on_status)
        self._goal_publisher = topics.advertise("goal", topics.message_type("Goal"))
        self._cancel_publisher = topics.advertise("cancel", GOAL_ID)
        self.handle = self._goal_publisher

    def send_goal(self, goal: Message) -> str:
        """Send a goal, now or when the server is connected; return its id."""
        goal_id, now = str(uuid.uuid4()), self._topics.now()
        message = {"header": {"stamp": now}, "goal_id": {"id": goal_id, "stamp": now}, "goal": goal}
        self._topics.check(self._goal_publisher, message)
        self._outgoing.append((self._goal_publisher, copy.deepcopy(message)))
        self._goals[goal_id] = _Sent()
        self._last_goal = goal_id
        self.send_outgoing()
        return goal_id

    def cancel_last_goal(self) -> bool:
        """Request the server to cancel the last goal; return False if there is none or it has ended."""
        if self._last_goal not in self._goals:
            return False
        self._outgoing.append((self._cancel_publisher, {"id": self._last_goal}))
        self.send_outgoing()
        return True

    def send_outgoing(self) -> None:
        """Send queued messages if the server is connected; call it in every step."""
        if self._topics.closed:
            return
        if not self._topics.are_connected():  # otherwise the server's response would be lost
            self._server_ready = False  # the next connection is another server
        while self._server_ready and self._outgoing:
            self._topics.publish(*self._outgoing.popleft())

    def close(self) -> None:
        """Delete all goals and shut down the topics, without notifying the server."""
        self._goals.clear()
        self._topics.close()

    def _on_status(self, message: dict[str, Any]) -> None:
        self._server_ready = True
        statuses = {each["goal_id"]["id"]: each["status"] for each in message["status_list"]}
        for goal_id, sent in list(self._goals.items()):
            if goal_id in statuses:
                sent.seen = True
                self._answer(goal_id, statuses[goal_id])
            elif sent.seen:
                self._finish(goal_id, GoalStatus.LOST, self._topics.default_result())
        self.send_outgoing()

    def _on_feedback(self, message: dict[str, Any]) -> None:
        goal_id = message["status"]["goal_id"]["id"]
        self._answer(goal_id, GoalStatus.ACTIVE)  # messages on different topics arrive in any order
        if goal_id in self._goals:
            self._feedback(goal_id, message["feedback"])

    def _on_result(self, message: dict[str, Any]) -> None:
        self._finish(message["status"]["goal_id"]["id"], message["status"]["status"], message["result"])

    def _answer(self, goal_id: str, status: int) -> None:
        """Report once to the script whether the goal was accepted; a rejected goal has ended."""
        sent = self._goals.get(goal_id)
        if sent is None or sent.answered or status in _UNDECIDED:
            return
        sent.answered = True
        accepted = status not in _REFUSED
        if not accepted:
            del self._goals[goal_id]
        self._goal_response(goal_id, accepted)

    def _finish(self, goal_id: str, status: int, result: Message) -> None:
        self._answer(goal_id, status)
        if self._goals.pop(goal_id, None) is not None:
            self._result(goal_id, int(_CODES.get(status, ResultCode.UNKNOWN)), result)
