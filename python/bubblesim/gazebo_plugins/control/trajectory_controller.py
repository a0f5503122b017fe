# SPDX-License-Identifier: BSD-3-Clause
"""joint_trajectory_controller: trajectories by topic and by the action follow_joint_trajectory."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

from bubblesim import _core
from bubblesim._core.control import GoalStatus, TrajectoryController, TrajectorySettings
from bubblesim.gazebo_plugins.control.controller import Controller, Robot, read_gains
from bubblesim.gazebo_plugins.control.ros_parameters import ControllerError, ControllerParameters
from bubblesim.gazebo_plugins.plugin import Message
from bubblesim.gazebo_plugins.rate import Rate
from bubblesim.scripting.api.ros.action_server import ACCEPT, REJECT, ActionServer
from bubblesim.scripting.api.ros.action_topics import ActionTopics

_SUCCESSFUL, _INVALID_GOAL, _INVALID_JOINTS, _OLD_STAMP, _PATH_VIOLATED, _GOAL_VIOLATED = 0, -1, -2, -3, -4, -5
_POINTS = ("positions", "velocities", "accelerations")

_Tolerance = tuple[float, float, float]


class _RefusedError(ValueError):
    def __init__(self, code: int, text: str) -> None:
        super().__init__(text)
        self.code = code


class JointTrajectory(Controller):
    """JointTrajectoryController of position_controllers, velocity_controllers and effort_controllers."""

    kind = "effort"

    def __init__(self, robot: Robot, name: str, parameters: ControllerParameters) -> None:
        """Read the parameters."""
        super().__init__(robot, name, parameters)
        p = parameters
        self._joints = p.names("joints")
        indices = self.claim(self.kind, self._joints)
        has_gains = p.has("gains")
        if self.kind == "effort" and not has_gains:
            raise ControllerError(f"parameter {p.name}/gains is missing: the gains p, i and d of each joint")
        gains = (
            [read_gains(p.below("gains", joint)) for joint in self._joints]
            if has_gains and self.kind != "position"
            else []
        )
        feed = [p.below("velocity_ff").number(joint, 0.0) for joint in self._joints]
        wraps = [bool(robot.manager.is_continuous(index)) for index in indices]
        settings = TrajectorySettings(indices, gains, feed, wraps, p.number("stop_trajectory_duration", 0.0))
        self.core = TrajectoryController(robot.manager, settings)
        self._partial = p.flag("allow_partial_joints_goal", default=False)
        self._read_constraints(p.below("constraints"))
        self._rate = self.rate("state_publish_rate", 50.0)
        self._feedback = Rate(p.length("action_monitor_rate", 20.0), robot.plugin.simulation)
        self._publisher = self.advertise(self.topic("state"), "control_msgs/JointTrajectoryControllerState")
        self.subscribe("command", "trajectory_msgs/JointTrajectory", self._on_command)
        self._goal: str | None = None
        bridge = robot.plugin.bridge
        topics = ActionTopics(
            bridge, self.topic("follow_joint_trajectory"), "control_msgs/FollowJointTrajectory", lambda *_: None
        )
        self._actions = ActionServer(topics, self._on_goal, self._on_cancel, lambda *_: None)
        self._endpoints.append(self._actions.close)
        server = bridge.advertise_service(
            self.topic("query_state"), "control_msgs/QueryTrajectoryState", self._query, _core.messages.TimeForm.FLOAT
        )
        self._endpoints.append(lambda: bridge.shutdown_service_server(server))

    def _read_constraints(self, constraints: ControllerParameters) -> None:
        self._goal_time = constraints.number("goal_time", 0.0)
        stopped = constraints.number("stopped_velocity_tolerance", 0.01)
        of_joints = [constraints.below(joint) for joint in self._joints]
        self._path: list[_Tolerance] = [(each.number("trajectory", 0.0), 0.0, 0.0) for each in of_joints]
        self._end: list[_Tolerance] = [(each.number("goal", 0.0), stopped, 0.0) for each in of_joints]

    def stop(self) -> None:
        """Stop it; the goal is cancelled."""
        self._end_goal("be canceled", _SUCCESSFUL, "")
        super().stop()

    def reset(self) -> None:
        """Abort the goal, and reset the rates."""
        self._end_goal("abort", _INVALID_GOAL, "the simulation was reset")
        self._rate.reset()
        self._feedback.reset()

    def publish(self) -> None:
        """Publish the state, and feedback or the result of the goal."""
        self._actions.publish_status_when_due()
        if self._goal is not None:
            self._watch_goal()
        due = self._rate.due()
        if due and self.is_needed(self._publisher):
            self.send(self._publisher, {"header": {"stamp": self.robot.stamp()}, **self._state()})

    def _state(self) -> Message:
        columns = {"desired": self.core.desired(), "actual": self.core.actual(), "error": self.core.error()}
        points = {name: dict(zip(_POINTS, column, strict=True)) for name, column in columns.items()}
        for name in ("actual", "error"):
            points[name].pop("accelerations")  # which are not measured
        return {"joint_names": self._joints, **points}

    def _watch_goal(self) -> None:
        status = self.core.goal_status()
        if status == GoalStatus.REACHED:
            self._end_goal("succeed", _SUCCESSFUL, "")
        elif status == GoalStatus.PATH_VIOLATED:
            self._end_goal("abort", _PATH_VIOLATED, f"{self._violation()} has left its path")
        elif status == GoalStatus.GOAL_MISSED:
            self._end_goal("abort", _GOAL_VIOLATED, f"{self._violation()} has not reached its goal")
        elif self._feedback.due():
            assert self._goal is not None
            header = {"stamp": self.robot.stamp()}
            self._actions.publish_feedback(self._goal, {"header": header, **self._state()})

    def _violation(self) -> str:
        joint = self.core.violating_joint()
        return f"joint {self._joints[joint]} (error {self.core.error()[0][joint]:.4g})"

    def _end_goal(self, how: str, code: int, text: str) -> None:
        if self._goal is not None:
            goal, self._goal = self._goal, None
            self._actions.finish(goal, how, {"error_code": code, "error_string": text})

    def _on_command(self, message: Message) -> None:
        self._end_goal("be canceled", _SUCCESSFUL, "")
        if not message["points"]:
            self.core.hold(self._now())
            return
        self._follow(message, None, _float)

    def _on_goal(self, goal_id: str, goal: Mapping[str, Any]) -> int:
        try:
            if self.state != "running":
                raise _RefusedError(_INVALID_GOAL, "the controller does not run")
            tolerances = self._tolerances(goal)
            self._follow(goal["trajectory"], tolerances, _seconds)
        except ValueError as error:
            self.warn(f"a goal is rejected: {error}")
            code = error.code if isinstance(error, _RefusedError) else _INVALID_GOAL
            self._actions.finish(goal_id, "be rejected", {"error_code": code, "error_string": str(error)})
            return REJECT
        self._end_goal("be canceled", _SUCCESSFUL, "a new goal has arrived")
        self._goal = goal_id
        return ACCEPT

    def _on_cancel(self, goal_id: str, _: Mapping[str, Any]) -> int:
        if goal_id == self._goal:
            self.core.hold(self._now())
            self._end_goal("be canceled", _SUCCESSFUL, "")
        return REJECT  # which leaves the state as it is

    def _tolerances(self, goal: Mapping[str, Any]) -> tuple[list[_Tolerance], list[_Tolerance], float]:
        path, end = list(self._path), list(self._end)
        for tolerances, given in ((path, goal["path_tolerance"]), (end, goal["goal_tolerance"])):
            for each in given:
                if each["name"] in self._joints:
                    index = self._joints.index(each["name"])
                    keys = ("position", "velocity", "acceleration")
                    tolerances[index] = tuple(  # type: ignore[assignment]
                        _tolerance(each[key], default) for key, default in zip(keys, tolerances[index], strict=True)
                    )
        return path, end, _tolerance(_seconds(goal["goal_time_tolerance"]), self._goal_time)

    def _follow(self, trajectory: Message, goal: Any, seconds: Any) -> None:
        names = list(trajectory["joint_names"])
        unknown = [name for name in names if name not in self._joints]
        if unknown or len(set(names)) != len(names) or (len(names) < len(self._joints) and not self._partial):
            raise _RefusedError(_INVALID_JOINTS, f"its joints are {', '.join(names)}, not {', '.join(self._joints)}")
        if not trajectory["points"]:
            raise _RefusedError(_INVALID_GOAL, "it has no points")
        now = self._now()
        start = seconds(trajectory["header"]["stamp"]) or now
        knots = [
            _knots(trajectory["points"], names.index(name), start, seconds) if name in names else []
            for name in self._joints
        ]
        end = knots[self._joints.index(names[0])][-1][0]
        if end < now:
            raise _RefusedError(_OLD_STAMP, f"all its points are over: the last one is {now - end:.3f} s ago")
        for index, of_joint in enumerate(knots):
            if not of_joint:  # it stays where it is
                of_joint.append((end, self.core.at(now)[0][index], 0.0, 0.0))
        self.core.follow(knots, start, now, goal)

    def _now(self) -> float:
        return float(self.robot.plugin.simulation.state_time)

    def _query(self, request: Message) -> Message:
        if self.state != "running":
            return {"success": False, "message": "the controller does not run"}
        position, velocity, acceleration = self.core.at(request["time"])
        return {
            "success": True,
            "name": self._joints,
            "position": position,
            "velocity": velocity,
            "acceleration": acceleration,
        }


def _knots(points: Sequence[Message], index: int, start: float, seconds: Any) -> list[Any]:
    knots: list[Any] = []
    for number, point in enumerate(points):
        position, velocity, acceleration = (_value(point[key], index) for key in _POINTS)
        if position is None:
            raise _RefusedError(_INVALID_GOAL, f"point {number} has no position of each joint")
        knots.append((start + seconds(point["time_from_start"]), position, velocity, acceleration))
    return knots


def _value(values: Sequence[float], index: int) -> float | None:
    return float(values[index]) if index < len(values) else None


def _tolerance(given: float, default: float) -> float:
    """Return a tolerance: 0 leaves the default, a negative number means none."""
    return default if given == 0.0 else max(0.0, given)


def _seconds(stamp: Message) -> float:
    return float(stamp["sec"] + stamp["nanosec"] * 1e-9)


def _float(stamp: float) -> float:
    return stamp
