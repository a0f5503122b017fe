# SPDX-License-Identifier: BSD-3-Clause
"""The services of gazebo_ros that push links and joints for a time."""

from __future__ import annotations

from typing import Any

from bubblesim import _core
from bubblesim.geometry.frames import out_of
from bubblesim.ros_messages import vector_values
from bubblesim.services.answers import Message, failing, report_errors
from bubblesim.services.gazebo_names import find_entity, find_frame


class GazeboForces:
    """Advertised during the lifetime of the bridge. A device of the world applies the forces in each substep."""

    def __init__(self, bridge: Any, simulation: Any) -> None:
        """Advertise the services below /gazebo."""
        self._simulation = simulation
        self._world = simulation.world
        self._efforts = _core.TimedEfforts(self._world)
        for name, kind, answer in (
            ("apply_body_wrench", "ApplyBodyWrench", report_errors(self._push_body)),
            ("clear_body_wrenches", "BodyRequest", failing(self._release_body)),
            ("apply_joint_effort", "ApplyJointEffort", report_errors(self._push_joint)),
            ("clear_joint_forces", "JointRequest", failing(self._release_joint)),
        ):
            bridge.advertise_service(f"/gazebo/{name}", f"gazebo_msgs/{kind}", answer, _core.messages.TimeForm.FLOAT)

    def _push_body(self, request: Message) -> Message:
        link = self._body(request)
        frame = find_frame(self._world, request["reference_frame"])
        force, torque = (vector_values(request["wrench"][part]) for part in ("force", "torque"))
        point = None  # in the world, Gazebo ignores the reference point too
        if frame is not None:
            axes = self._world.pose(frame)
            force, torque = out_of(axes, force), out_of(axes, torque)
            point = self._point_in(link, frame, vector_values(request["reference_point"]))
        self._efforts.add_wrench(link, force, torque, point, *self._interval(request))
        return {"status_message": "ApplyBodyWrench: wrench applied"}

    def _release_body(self, request: Message) -> Message:
        self._efforts.clear_wrenches(self._body(request))
        return {}

    def _push_joint(self, request: Message) -> Message:
        self._efforts.add_effort(self._joint(request), request["effort"], *self._interval(request))
        return {"status_message": "ApplyJointEffort: effort set"}

    def _release_joint(self, request: Message) -> Message:
        self._efforts.clear_efforts(self._joint(request))
        return {}

    def _body(self, request: Message) -> int:
        return find_entity(self._world, request["body_name"], "link")

    def _joint(self, request: Message) -> int:
        return find_entity(self._world, request["joint_name"], "joint")

    def _point_in(self, link: int, frame: int, point: list[float]) -> list[float]:
        """Return a point of a frame in the frame of a link."""
        in_world = self._world.pose_from([*point, 0.0, 0.0, 0.0, 1.0], frame)
        return list(self._world.pose_to(in_world, link)[:3])

    def _interval(self, request: Message) -> tuple[float, float]:
        """Return the start, in simulation time, and the duration; s."""
        return max(request["start_time"], self._simulation.time), request["duration"]
