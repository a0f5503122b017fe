# SPDX-License-Identifier: BSD-3-Clause
"""Action client of ROS 2: sends goals and follows them to their results."""

from __future__ import annotations

import copy
import uuid
from collections import deque
from collections.abc import Callable
from functools import partial
from typing import Any

from bubblesim.scripting.api.ros.action_endpoints import TIME_FORM
from bubblesim.scripting.api.ros.ros2_action_parts import Ros2ActionParts, Status, id_message, id_of
from bubblesim.scripting.api.ros.stamps import Message

_NO_TIME = {"sec": 0, "nanosec": 0}


class Ros2ActionClient:
    """Callbacks are called while pending input is processed."""

    def __init__(
        self,
        parts: Ros2ActionParts,
        goal_response: Callable[[str, bool], None],
        feedback: Callable[[str, Message], None],
        result: Callable[[str, int, Message], None],
    ) -> None:
        """Create the endpoints."""
        self._parts = parts
        self._goal_response = goal_response
        self._feedback = feedback
        self._result = result
        self._goals: dict[str, bool] = {}  # goals that have not ended: whether the script knows that they are accepted
        self._last_goal = ""
        self._outgoing: deque[tuple[str, Message]] = deque()  # id, goal
        self._cancels: deque[str] = deque()
        self.handle = parts.subscribe("feedback", parts.feedback_type, self._on_feedback)
        self._send, self._cancel, self._get_result = map(parts.client, ("send_goal", "cancel_goal", "get_result"))

    def send_goal(self, goal: Message) -> str:
        """Send a goal, now or when the server is there; return its id."""
        self._parts.check_goal(goal)
        goal_id = str(uuid.uuid4())
        self._goals[goal_id] = False
        self._outgoing.append((goal_id, copy.deepcopy(goal)))
        self._last_goal = goal_id
        self.send_outgoing()
        return goal_id

    def cancel_last_goal(self) -> bool:
        """Request the server to cancel the last goal; return False if there is none or it has ended."""
        if self._last_goal not in self._goals:
            return False
        self._cancels.append(self._last_goal)
        self.send_outgoing()
        return True

    def send_outgoing(self) -> None:
        """Send what waits for the server; call it in every step."""
        if self._parts.closed:
            return
        is_ready = self._parts.bridge.service_is_ready
        if not is_ready(self._get_result):
            for goal_id in [goal for goal, accepted in self._goals.items() if accepted]:  # the server is gone
                self._finish(goal_id, Status.UNKNOWN, self._parts.default_result())
            return
        while self._outgoing and is_ready(self._send):
            goal_id, goal = self._outgoing.popleft()
            self._call(self._send, {"goal_id": id_message(goal_id), "goal": goal}, partial(self._answer, goal_id))
        while self._cancels and not self._outgoing and is_ready(self._cancel):
            goal_info = {"goal_id": id_message(self._cancels.popleft()), "stamp": _NO_TIME}
            self._call(self._cancel, {"goal_info": goal_info}, lambda _answer: None)

    def close(self) -> None:
        """Forget all goals and shut down the endpoints, without notifying the server."""
        self._goals.clear()
        self._parts.close()

    def _call(self, client: int, request: Message, callback: Callable[[Any], None]) -> None:
        self._parts.bridge.call_later(client, request, callback, TIME_FORM)

    def _answer(self, goal_id: str, answer: Message) -> None:
        if goal_id not in self._goals:
            return
        if not answer["accepted"]:
            del self._goals[goal_id]
            self._goal_response(goal_id, False)
            return
        self._accepted(goal_id)
        if not self._parts.closed:
            request = {"goal_id": id_message(goal_id)}
            self._call(self._get_result, request, lambda got: self._finish(goal_id, got["status"], got["result"]))

    def _accepted(self, goal_id: str) -> None:
        """Report once that a goal was accepted: feedback may arrive before the answer."""
        if not self._goals[goal_id]:
            self._goals[goal_id] = True
            self._goal_response(goal_id, True)

    def _on_feedback(self, message: dict[str, Any]) -> None:
        goal_id = id_of(message["goal_id"])
        if goal_id in self._goals:
            self._accepted(goal_id)
        if goal_id in self._goals:
            self._feedback(goal_id, message["feedback"])

    def _finish(self, goal_id: str, status: int, result: Message) -> None:
        if self._goals.pop(goal_id, None) is not None:
            self._result(goal_id, int(status), result)
