# SPDX-License-Identifier: BSD-3-Clause
"""The action /simulate_steps of ROS 2's standard for simulators."""

from __future__ import annotations

import time
from typing import Any

from bubblesim._core import RunState
from bubblesim.scripting.api.ros.action_server import ACCEPT, REJECT
from bubblesim.scripting.api.ros.action_topics import GoalStatus
from bubblesim.scripting.api.ros.ros2_action_parts import Ros2ActionParts
from bubblesim.scripting.api.ros.ros2_action_server import Ros2ActionServer
from bubblesim.scripting.api.ros.stamps import Message
from bubblesim.services.standard_services import Code

_LONGEST_WAIT = 10.0  # s of wall time for a step to begin: gates hold it back for five seconds at most


class SimulateSteps:
    """Runs the steps of one goal at a time, each by a request of its own so that a cancel request ends them."""

    def __init__(self, bridge: Any, runner: Any) -> None:
        """Create the action on a bridge of ROS 2."""
        parts = Ros2ActionParts(bridge, "/simulate_steps", "simulation_interfaces/SimulateSteps", lambda *_: None)
        self._server = Ros2ActionServer(
            parts, self._on_goal, lambda _id, _goal: ACCEPT, lambda goal_id, goal: self._begin(goal_id, goal["steps"])
        )
        self._runner = runner
        self._goal: str | None = None
        self._done = self._wanted = 0
        self._last_step = 0.0

    def process_input(self) -> None:
        """End a goal whose steps are not carried out; called between steps."""
        self._server.publish_status_when_due()
        if self._goal is None:
            return
        if self._server.is_in(self._goal, GoalStatus.PREEMPTING):
            self._finish("be canceled", "")  # not only at the end of the step, which may be held back
        elif self._runner.state != RunState.PAUSED:
            self._finish("abort", f"the simulation is {self._runner.state.name.lower()} meanwhile")
        elif time.monotonic() - self._last_step > _LONGEST_WAIT:
            self._finish("abort", f"step {self._done + 1} was not carried out: another request has ended it")

    def publish(self) -> None:
        """Count a step at its end."""
        if self._goal is None:
            return
        self._done += 1
        remaining = self._wanted - self._done
        self._server.publish_feedback(self._goal, {"completed_steps": self._done, "remaining_steps": remaining})
        if self._server.is_in(self._goal, GoalStatus.PREEMPTING):
            self._finish("be canceled", "")
        elif remaining == 0:
            self._finish("succeed", "")
        else:
            self._request_step()

    def _on_goal(self, _goal_id: str, goal: Message) -> int:
        return ACCEPT if self._goal is None and goal["steps"] > 0 else REJECT

    def _begin(self, goal_id: str, steps: int) -> None:
        self._goal, self._done, self._wanted = goal_id, 0, steps
        if self._runner.state == RunState.PAUSED:
            self._request_step()
        else:
            self._finish("abort", f"the simulation is {self._runner.state.name.lower()}: pause it first")

    def _request_step(self) -> None:
        self._last_step = time.monotonic()
        self._runner.step(wait=False)

    def _finish(self, how: str, problem: str) -> None:
        code = Code.OPERATION_FAILED if problem else Code.OK
        goal, self._goal = self._goal, None
        assert goal is not None
        self._server.finish(goal, how, {"result": {"result": int(code), "error_message": problem}})
