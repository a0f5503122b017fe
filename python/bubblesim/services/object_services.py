# SPDX-License-Identifier: BSD-3-Clause
"""The services ~set_object_pose and ~get_object_state."""

from __future__ import annotations

from typing import Any

from bubblesim import _core
from bubblesim.geometry.frames import state_in
from bubblesim.ros_messages import pose_message, pose_values, twist_message
from bubblesim.services.answers import Message, failing, report_errors
from bubblesim.services.names import find_object


class ObjectServices:
    """Advertised during the lifetime of the bridge."""

    def __init__(self, simulation: Any, bridge: Any) -> None:
        """Advertise the services in the node's namespace."""
        self._simulation = simulation
        self._world = simulation.world
        for name, service_type, answer in (
            ("~set_object_pose", "bubblesim_msgs/SetObjectPose", report_errors(self._set_pose)),
            ("~get_object_state", "bubblesim_msgs/GetObjectState", failing(self._get_state)),
        ):
            bridge.advertise_service(name, service_type, answer, _core.messages.TimeForm.FLOAT)

    def _set_pose(self, request: Message) -> Message:
        handle = find_object(self._world, request["object"])
        pose = pose_values(request["pose"])
        if request["reference"]:
            self._world.set_pose_in(handle, pose, find_object(self._world, request["reference"]))
        else:
            self._world.set_pose(handle, pose)
        return {}

    def _get_state(self, request: Message) -> Message:
        handle = find_object(self._world, request["object"])
        reference = find_object(self._world, request["reference"]) if request["reference"] else None
        pose, linear, angular = state_in(self._world, handle, reference)
        return {
            "success": True,
            "header": {"stamp": self._simulation.state_time, "frame_id": request["reference"]},
            "pose": pose_message(pose),
            "twist": twist_message(linear, angular),
        }
