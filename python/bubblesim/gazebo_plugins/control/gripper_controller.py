# SPDX-License-Identifier: BSD-3-Clause
"""gripper_action_controller: the action gripper_cmd moves a joint until it is there or stalls."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from bubblesim._core.control import ForwardCommand, PidController, PidKind
from bubblesim.gazebo_plugins.control.controller import Controller, Robot, read_gains
from bubblesim.gazebo_plugins.control.ros_parameters import ControllerParameters
from bubblesim.gazebo_plugins.plugin import Message
from bubblesim.gazebo_plugins.rate import Rate
from bubblesim.scripting.api.ros.action_server import ACCEPT, REJECT, ActionServer
from bubblesim.scripting.api.ros.action_topics import ActionTopics


class GripperAction(Controller):
    """GripperActionController of position_controllers and effort_controllers."""

    kind = "effort"

    def __init__(self, robot: Robot, name: str, parameters: ControllerParameters) -> None:
        """Read the parameters."""
        super().__init__(robot, name, parameters)
        p = parameters
        (index,) = self.claim(self.kind, [p.text("joint")])
        self._index = index
        if self.kind == "effort":
            gains = read_gains(p.below("gains", p.text("joint")))
            self.core = PidController(robot.manager, index, PidKind.POSITION, gains)
        else:
            self.core = ForwardCommand(robot.manager, [index])
        self._tolerance = p.length("goal_tolerance", 0.01)
        self._stall_velocity = p.length("stall_velocity_threshold", 0.001)
        self._stall_time = p.length("stall_timeout", 1.0)
        self._feedback = Rate(p.length("action_monitor_rate", 20.0), robot.plugin.simulation)
        self._goal: str | None = None
        self._target = 0.0
        self._moved = 0.0  # s, when it last moved
        topics = ActionTopics(
            robot.plugin.bridge, self.topic("gripper_cmd"), "control_msgs/GripperCommand", lambda *_: None
        )
        self._actions = ActionServer(topics, self._on_goal, self._on_cancel, lambda *_: None)
        self._endpoints.append(self._actions.close)

    def stop(self) -> None:
        """Stop it; the goal is cancelled."""
        self._finish("be canceled", stalled=False)
        super().stop()

    def reset(self) -> None:
        """Abort the goal."""
        self._finish("abort", stalled=False)
        self._feedback.reset()

    def publish(self) -> None:
        """Publish feedback or the result of the goal."""
        self._actions.publish_status_when_due()
        if self._goal is None:
            return
        position, velocity = self._state()[:2]
        now = float(self.robot.plugin.simulation.state_time)
        if abs(self._target - position) < self._tolerance:
            self._finish("succeed", stalled=False)
        elif abs(velocity) > self._stall_velocity:
            self._moved = now
        elif now - self._moved > self._stall_time:
            self._finish("abort", stalled=True)
        if self._goal is not None and self._feedback.due():
            self._actions.publish_feedback(self._goal, self._result(stalled=False))

    def _state(self) -> tuple[float, float, float]:
        position, velocity, effort = (column[self._index] for column in self.robot.manager.joint_states())
        return position, velocity, effort

    def _result(self, *, stalled: bool) -> Message:
        position, _, effort = self._state()
        reached = abs(self._target - position) < self._tolerance
        return {"position": position, "effort": effort, "stalled": stalled, "reached_goal": reached}

    def _finish(self, how: str, *, stalled: bool) -> None:
        if self._goal is not None:
            goal, self._goal = self._goal, None
            self._actions.finish(goal, how, self._result(stalled=stalled))

    def _on_goal(self, goal_id: str, goal: Mapping[str, Any]) -> int:
        if self.state != "running":
            self.warn("a goal is rejected: the controller does not run")
            return REJECT
        target = goal["command"]["position"]
        try:
            self._command(target)
        except ValueError as error:
            self.warn(f"a goal is rejected: {error}")
            return REJECT
        self._finish("be canceled", stalled=False)
        self._goal, self._target = goal_id, target
        self._moved = float(self.robot.plugin.simulation.state_time)
        return ACCEPT

    def _on_cancel(self, goal_id: str, _: Mapping[str, Any]) -> int:
        if goal_id == self._goal:
            self._command(self._state()[0])
            self._finish("be canceled", stalled=False)
        return REJECT  # which leaves the state as it is

    def _command(self, target: float) -> None:
        if self.kind == "effort":
            self.core.set_command(target)
        else:
            self.core.set_commands([target])
