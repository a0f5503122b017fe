# SPDX-License-Identifier: BSD-3-Clause
"""Action server of ROS 2: the received goals, their states, and the answers to clients."""

from __future__ import annotations

import time
import uuid
from collections.abc import Callable
from dataclasses import dataclass, field
from typing import Any

from bubblesim import _core
from bubblesim.scripting.api.ros.action_server import ACCEPT, REJECT, live_goal, response_of, seconds_and_rest
from bubblesim.scripting.api.ros.action_topics import GoalStatus
from bubblesim.scripting.api.ros.ros2_action_parts import STATUS_ARRAY, Ros2ActionParts, Status, id_message, id_of
from bubblesim.scripting.api.ros.stamps import Message

_KEPT = 10.0  # s of wall time for which results are kept, rcl's default
_NOBODY = str(uuid.UUID(int=0))

# Return codes of action_msgs/CancelGoal
_NONE, _REJECTED, _UNKNOWN_GOAL, _TERMINATED = range(4)

_FINAL = {
    "succeed": ((Status.EXECUTING, Status.CANCELING), Status.SUCCEEDED),
    "abort": ((Status.EXECUTING, Status.CANCELING), Status.ABORTED),
    "be canceled": ((Status.ACCEPTED, Status.EXECUTING, Status.CANCELING), Status.CANCELED),
}
# The states of actionlib, by which scripts ask, and those of ROS 2.
_STATES = {
    GoalStatus.PENDING: Status.ACCEPTED,
    GoalStatus.ACTIVE: Status.EXECUTING,
    GoalStatus.RECALLING: Status.CANCELING,
    GoalStatus.PREEMPTING: Status.CANCELING,
}


@dataclass
class _Goal:
    id: str
    stamp: Message
    goal: Message
    status: Status = Status.ACCEPTED
    result: Message = field(default_factory=dict)
    ended: float | None = None  # s of wall time
    waiting: list[int] = field(default_factory=list)  # requests for the result

    @property
    def info(self) -> Message:
        return {"goal_id": id_message(self.id), "stamp": self.stamp}

    @property
    def can_be_cancelled(self) -> bool:
        return self.status in (Status.ACCEPTED, Status.EXECUTING)


class Ros2ActionServer:
    """Handles several goals at a time; callbacks run while pending input is processed."""

    def __init__(
        self,
        parts: Ros2ActionParts,
        handle_goal: Callable[[str, Message], int],
        handle_cancel: Callable[[str, Message], int],
        handle_accepted: Callable[[str, Message], None],
    ) -> None:
        """Create the endpoints."""
        self._parts = parts
        self._handle_goal = handle_goal
        self._handle_cancel = handle_cancel
        self._handle_accepted = handle_accepted
        self._goals: dict[str, _Goal] = {}
        self._status = parts.advertise("status", STATUS_ARRAY, _core.Qos(1, transient_local=True))
        self._feedback = parts.advertise("feedback", parts.feedback_type, 10)
        self._results = parts.serve("get_result", self._on_get_result)
        self._cancels = parts.serve("cancel_goal", self._on_cancel)
        self._sends = parts.serve("send_goal", self._on_goal)
        self.handle = self._status
        self._publish_status()

    def publish_feedback(self, goal_id: str, feedback: Message) -> None:
        """Publish feedback on a goal."""
        goal = self._live_goal(goal_id)
        message = {"goal_id": id_message(goal.id), "feedback": feedback}
        self._parts.check(self._feedback, message)
        self._parts.publish(self._feedback, message)

    def execute(self, goal_id: str) -> None:
        """Start a goal that was accepted for deferred execution."""
        goal = self._live_goal(goal_id)
        if goal.status is not Status.ACCEPTED:
            raise ValueError(f"action server '{self._parts.name}': goal '{goal_id}' is {goal.status.name} already")
        goal.status = Status.EXECUTING
        self._publish_status()

    def finish(self, goal_id: str, how: str, result: Message) -> None:
        """End a goal and answer those who wait for its result; ``how`` is "succeed", "abort" or "be canceled"."""
        goal = self._live_goal(goal_id)
        allowed, final = _FINAL[how]
        if goal.status not in allowed:
            raise ValueError(
                f"action server '{self._parts.name}': goal '{goal_id}' is {goal.status.name} and cannot {how}; call "
                "simROS2.actionServerActionExecute first"
            )
        self._parts.check_result(result)
        goal.status, goal.result, goal.ended = final, result, time.monotonic()
        for number in goal.waiting:
            self._reply_result(number, goal.status, goal.result)
        goal.waiting.clear()
        self._publish_status()

    def is_in(self, goal_id: str, *statuses: GoalStatus) -> bool:
        """Return whether a goal is in one of these states; False for an unknown goal."""
        goal = self._goals.get(goal_id)
        return goal is not None and goal.status in [_STATES[status] for status in statuses if status in _STATES]

    def publish_status_when_due(self) -> None:
        """Forget old results; call it in every step. The status is published when it changes."""
        now = time.monotonic()
        old = [goal.id for goal in self._goals.values() if goal.ended is not None and now - goal.ended > _KEPT]
        for goal_id in old:
            del self._goals[goal_id]
        if old:
            self._publish_status()

    def close(self) -> None:
        """Shut down the endpoints, without notifying clients."""
        self._parts.close()

    def _live_goal(self, goal_id: str) -> _Goal:
        goal: _Goal = live_goal(self._parts.name, self._goals, goal_id)
        return goal

    def _on_goal(self, number: int, request: dict[str, Any]) -> None:
        goal = _Goal(id_of(request["goal_id"]), self._parts.now(), request["goal"])
        answer = REJECT if goal.id in self._goals else response_of(self._handle_goal, goal.id, goal.goal)
        if self._parts.closed:
            return
        accepted = answer != REJECT
        if accepted:
            goal.status = Status.EXECUTING if answer == ACCEPT else Status.ACCEPTED
            self._goals[goal.id] = goal
        self._parts.bridge.reply(self._sends, number, {"accepted": accepted, "stamp": goal.stamp})
        if accepted:
            self._publish_status()
            self._handle_accepted(goal.id, goal.goal)

    def _on_get_result(self, number: int, request: dict[str, Any]) -> None:
        goal = self._goals.get(id_of(request["goal_id"]))
        if goal is None:
            self._reply_result(number, Status.UNKNOWN, {})
        elif goal.ended is not None:
            self._reply_result(number, goal.status, goal.result)
        else:
            goal.waiting.append(number)

    def _on_cancel(self, number: int, request: dict[str, Any]) -> None:
        goal_id, stamp = id_of(request["goal_info"]["goal_id"]), seconds_and_rest(request["goal_info"]["stamp"])
        cancelling: list[_Goal] = []
        wanted = [goal for goal in self._goals.values() if _is_meant(goal, goal_id, stamp)]
        for goal in wanted:
            if not goal.can_be_cancelled:
                continue
            answer = response_of(self._handle_cancel, goal.id, goal.goal)
            if self._parts.closed:
                return
            if answer == ACCEPT and goal.can_be_cancelled:  # the callback may have ended the goal
                goal.status = Status.CANCELING
                cancelling.append(goal)
        code = _NONE if cancelling else self._refusal(goal_id)
        response = {"return_code": code, "goals_canceling": [goal.info for goal in cancelling]}
        self._parts.bridge.reply(self._cancels, number, response)
        self._publish_status()

    def _refusal(self, goal_id: str) -> int:
        if goal_id == _NOBODY:
            return _REJECTED
        goal = self._goals.get(goal_id)
        return _UNKNOWN_GOAL if goal is None else _REJECTED if goal.ended is None else _TERMINATED

    def _reply_result(self, number: int, status: Status, result: Message) -> None:
        self._parts.bridge.reply(self._results, number, {"status": int(status), "result": result})

    def _publish_status(self) -> None:
        if not self._parts.closed:
            statuses = [{"goal_info": goal.info, "status": int(goal.status)} for goal in self._goals.values()]
            self._parts.publish(self._status, {"status_list": statuses})


def _is_meant(goal: _Goal, goal_id: str, until: tuple[int, int]) -> bool:
    """By action_msgs/CancelGoal: this goal, all until a time, or all."""
    if goal_id == _NOBODY and not any(until):
        return True
    return goal.id == goal_id or (any(until) and seconds_and_rest(goal.stamp) <= until)
