# SPDX-License-Identifier: BSD-3-Clause
"""Action server: the received goals, their states, and the messages to clients."""

from __future__ import annotations

import time
import uuid
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Any

from bubblesim import _core
from bubblesim.scripting.api.ros.action_endpoints import QUEUE_SIZE
from bubblesim.scripting.api.ros.action_topics import GOAL_ID, STATUS_ARRAY, ActionTopics, GoalStatus
from bubblesim.scripting.api.ros.stamps import Message

# Return values of the callbacks; False and True equal the first two.
REJECT, ACCEPT, DEFER = range(3)

_STATUS_PERIOD = 0.2  # s of wall time, actionlib's default
_KEPT = 5.0  # s of wall time for which ended goals stay in the status, actionlib's default

_LIVE = {
    "execute": {GoalStatus.PENDING: GoalStatus.ACTIVE, GoalStatus.RECALLING: GoalStatus.PREEMPTING},
    "cancel": {GoalStatus.PENDING: GoalStatus.RECALLING, GoalStatus.ACTIVE: GoalStatus.PREEMPTING},
}
_FINAL = {
    "succeed": {GoalStatus.ACTIVE: GoalStatus.SUCCEEDED, GoalStatus.PREEMPTING: GoalStatus.SUCCEEDED},
    "abort": {GoalStatus.ACTIVE: GoalStatus.ABORTED, GoalStatus.PREEMPTING: GoalStatus.ABORTED},
    "be canceled": {
        GoalStatus.PENDING: GoalStatus.RECALLED,
        GoalStatus.RECALLING: GoalStatus.RECALLED,
        GoalStatus.ACTIVE: GoalStatus.PREEMPTED,
        GoalStatus.PREEMPTING: GoalStatus.PREEMPTED,
    },
    "be rejected": {GoalStatus.PENDING: GoalStatus.REJECTED},
}


@dataclass
class _Goal:
    id: str
    stamp: Message
    goal: Message | None  # None: only a cancel request was received
    status: GoalStatus = GoalStatus.PENDING
    ended: float | None = None  # s of wall time

    def message(self) -> Message:
        return {"goal_id": {"id": self.id, "stamp": self.stamp}, "status": int(self.status)}


class ActionServer:
    """Handles several goals at a time by actionlib's protocol; callbacks run while pending input is processed."""

    def __init__(
        self,
        topics: ActionTopics,
        handle_goal: Callable[[str, Message], int],
        handle_cancel: Callable[[str, Message], int],
        handle_accepted: Callable[[str, Message], None],
    ) -> None:
        """Create the topics."""
        self._topics = topics
        self._handle_goal = handle_goal
        self._handle_cancel = handle_cancel
        self._handle_accepted = handle_accepted
        self._goals: dict[str, _Goal] = {}
        self._last_cancel = (0, 0)  # goals stamped up to this time are cancelled on arrival
        self._next_status = 0.0
        self._status_publisher = topics.advertise("status", STATUS_ARRAY, _core.Qos(QUEUE_SIZE, transient_local=True))
        self._result_publisher = topics.advertise("result", topics.message_type("Result"))
        self._feedback_publisher = topics.advertise("feedback", topics.message_type("Feedback"))
        topics.subscribe("cancel", GOAL_ID, self._on_cancel)
        topics.subscribe("goal", topics.message_type("Goal"), self._on_goal)
        self.handle = self._status_publisher
        self._publish_status()

    def publish_feedback(self, goal_id: str, feedback: Message) -> None:
        """Publish feedback on a goal."""
        goal = self._live_goal(goal_id)
        message = {"header": {"stamp": self._topics.now()}, "status": goal.message(), "feedback": feedback}
        self._topics.check(self._feedback_publisher, message)
        self._topics.publish(self._feedback_publisher, message)

    def execute(self, goal_id: str) -> None:
        """Start a goal that was accepted for deferred execution."""
        goal = self._live_goal(goal_id)
        goal.status = self._next_of(goal, _LIVE, "execute")
        self._publish_status()

    def finish(self, goal_id: str, how: str, result: Message) -> None:
        """End a goal and publish its result.

        :param how: "succeed", "abort" or "be canceled"; "be rejected" while ``handle_goal`` decides about it.
        """
        goal = self._live_goal(goal_id)
        self._end(goal, self._next_of(goal, _FINAL, how), result)

    def is_in(self, goal_id: str, *statuses: GoalStatus) -> bool:
        """Return whether a goal is in one of these states; False for an unknown goal."""
        return goal_id in self._goals and self._goals[goal_id].status in statuses

    def publish_status_when_due(self) -> None:
        """Publish the status at a fixed rate; call it in every step."""
        if time.monotonic() >= self._next_status:
            self._publish_status()

    def close(self) -> None:
        """Shut down the topics, without notifying clients."""
        self._topics.close()

    def _live_goal(self, goal_id: str) -> _Goal:
        goal: _Goal = live_goal(self._topics.name, self._goals, goal_id)
        return goal

    def _next_of(self, goal: _Goal, changes: dict[str, dict[GoalStatus, GoalStatus]], what: str) -> GoalStatus:
        if goal.status in changes[what]:
            return changes[what][goal.status]
        waits = goal.status in _LIVE["execute"]
        raise ValueError(
            f"action server '{self._topics.name}': goal '{goal.id}' is {goal.status.name} and cannot {what}"
            + ("; call simROS2.actionServerActionExecute first" if waits else "")
        )

    def _on_goal(self, message: dict[str, Any]) -> None:
        stamp = message["goal_id"]["stamp"]
        when = seconds_and_rest(stamp)
        goal = _Goal(
            message["goal_id"]["id"] or str(uuid.uuid4()),
            stamp if any(when) else self._topics.now(),
            message["goal"],
        )
        known = self._goals.setdefault(goal.id, goal)
        if known is not goal:
            if known.goal is None and known.status is GoalStatus.RECALLING:
                self._end(known, GoalStatus.RECALLED, {})
        elif any(when) and when <= self._last_cancel:
            self._end(goal, GoalStatus.RECALLED, {})
        else:
            self._decide(goal, message["goal"])

    def _decide(self, goal: _Goal, content: Message) -> None:
        answer = response_of(self._handle_goal, goal.id, content)
        if self._topics.closed or goal.status is not GoalStatus.PENDING:  # ended in the callback
            return
        if answer == REJECT:
            self._end(goal, GoalStatus.REJECTED, {})
            return
        if answer == ACCEPT:
            goal.status = GoalStatus.ACTIVE
        self._publish_status()
        self._handle_accepted(goal.id, content)

    def _on_cancel(self, message: dict[str, Any]) -> None:
        goal_id, until = message["id"], seconds_and_rest(message["stamp"])
        everything = not goal_id and not any(until)
        for goal in list(self._goals.values()):
            up_to_then = any(until) and seconds_and_rest(goal.stamp) <= until
            if everything or goal.id == goal_id or up_to_then:
                self._request_cancel(goal)
            if self._topics.closed:
                return
        if goal_id and goal_id not in self._goals:
            # The goal may arrive after its cancel request.
            self._goals[goal_id] = _Goal(
                goal_id, message["stamp"], None, status=GoalStatus.RECALLING, ended=time.monotonic()
            )
        self._last_cancel = max(self._last_cancel, until)
        self._publish_status()

    def _request_cancel(self, goal: _Goal) -> None:
        if goal.goal is None or goal.status not in _LIVE["cancel"]:
            return
        answer = response_of(self._handle_cancel, goal.id, goal.goal)
        if answer == ACCEPT and goal.status in _LIVE["cancel"]:  # the callback may have ended the goal
            goal.status = _LIVE["cancel"][goal.status]

    def _end(self, goal: _Goal, status: GoalStatus, result: Message) -> None:
        message = {
            "header": {"stamp": self._topics.now()},
            "status": {**goal.message(), "status": int(status)},
            "result": result,
        }
        self._topics.check(self._result_publisher, message)
        goal.status, goal.ended = status, time.monotonic()
        self._topics.publish(self._result_publisher, message)
        self._publish_status()

    def _publish_status(self) -> None:
        now = time.monotonic()
        self._next_status = now + _STATUS_PERIOD
        self._goals = {each.id: each for each in self._goals.values() if each.ended is None or now < each.ended + _KEPT}
        statuses = [each.message() for each in self._goals.values()]
        self._topics.publish(self._status_publisher, {"header": {"stamp": self._topics.now()}, "status_list": statuses})


def live_goal(server: str, goals: Mapping[str, Any], goal_id: str) -> Any:
    """Return a goal that has not ended; raise ValueError if there is none."""
    goal = goals.get(goal_id)
    if goal is not None and goal.ended is None:
        return goal
    live = [each.id for each in goals.values() if each.ended is None]
    reason = "it is unknown" if goal is None else f"it has ended as {goal.status.name}"
    raise ValueError(f"action server '{server}' has no goal '{goal_id}': {reason}; its goals are {live or 'none'}")


def response_of(callback: Callable[[str, Message], int], goal_id: str, goal: Message) -> int:
    """Return what a script's callback answers."""
    try:
        return int(callback(goal_id, goal))
    except _core.ServiceError:
        return REJECT  # the script has failed, which has ended the server


def seconds_and_rest(stamp: Message) -> tuple[int, int]:
    """Return a stamp as (sec, nanosec), to compare."""
    return int(stamp["sec"]), int(stamp["nanosec"])
