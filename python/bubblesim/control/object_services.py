# SPDX-License-Identifier: BSD-3-Clause
"""The services ~set_object_pose and ~get_object_state."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from bubblesim import _core
from bubblesim.control.frames import pose_message, pose_values, state_in, vector_message

Message = dict[str, Any]


class ObjectServices:
    """Offered as long as the bridge is there."""

    def __init__(self, simulation: Any, bridge: Any) -> None:
        """Offer the services under the node's name."""
        self._simulation = simulation
        self._world = simulation.world
        for name, service_type, answer in (
            ("~set_object_pose", "bubblesim_msgs/SetObjectPose", self._set_pose),
            ("~get_object_state", "bubblesim_msgs/GetObjectState", self._get_state),
        ):
            bridge.advertise_service(name, service_type, _telling_errors(answer), _core.messages.TimeForm.FLOAT)

    def _set_pose(self, request: Message) -> Message:
        handle = self._world.find(request["object"])
        pose = pose_values(request["pose"])
        if request["reference"]:
            self._world.set_pose_in(handle, pose, self._world.find(request["reference"]))
        else:
            self._world.set_pose(handle, pose)
        return {}

    def _get_state(self, request: Message) -> Message:
        handle = self._world.find(request["object"])
        reference = self._world.find(request["reference"]) if request["reference"] else None
        pose, linear, angular = state_in(self._world, handle, reference)
        return {
            "header": {"stamp": self._simulation.time, "frame_id": request["reference"]},
            "pose": pose_message(pose),
            "twist": {"linear": vector_message(linear), "angular": vector_message(angular)},
        }


def _telling_errors(answer: Callable[[Message], Message]) -> Callable[[Message], Message]:
    """Report what is wrong with a request in the response, where callers look for it."""

    def guarded(request: Message) -> Message:
        try:
            return {"success": True, **answer(request)}
        except (LookupError, ValueError) as error:
            return {"success": False, "status_message": str(error)}

    return guarded
