# SPDX-License-Identifier: BSD-3-Clause
"""The services of gazebo_ros, with its names and types.

One difference: a velocity set relative to a moving frame is read back with the same value, which is not so in
Gazebo.
"""

from __future__ import annotations

import math
from collections.abc import Sequence

from bubblesim import _core
from bubblesim.geometry.frames import state_from, state_in
from bubblesim.ros_messages import pose_message, pose_values, twist_message, vector_values
from bubblesim.scripting.host.host import ScriptHost
from bubblesim.services.answers import Message, answering_empty, report_errors
from bubblesim.services.gazebo_forces import GazeboForces
from bubblesim.services.gazebo_names import find_entity, find_frame


class GazeboServices:
    """Advertised during the lifetime of the host's bridge."""

    def __init__(self, host: ScriptHost) -> None:
        """Advertise the services below /gazebo."""
        assert host.bridge is not None
        self._host = host
        self._bridge = host.bridge
        self._simulation = host.simulation
        self._world = host.simulation.world
        self._advertise("pause_physics", "std_srvs/Empty", answering_empty(lambda: host.runner.pause(wait=False)))
        self._advertise("unpause_physics", "std_srvs/Empty", answering_empty(lambda: host.runner.start(wait=False)))
        for name, action in (("reset_world", self._simulation.reset_world), ("reset_simulation", host.restart)):
            self._bridge.set_priority(self._advertise(name, "std_srvs/Empty", answering_empty(action)))
        for name, kind, answer in (
            ("spawn_sdf_model", "SpawnModel", self._spawn),
            ("spawn_urdf_model", "SpawnModel", self._spawn),
            ("delete_model", "DeleteModel", self._delete),
            ("get_model_state", "GetModelState", self._get_model_state),
            ("set_model_state", "SetModelState", self._set_model_state),
            ("get_link_state", "GetLinkState", self._get_link_state),
            ("set_link_state", "SetLinkState", self._set_link_state),
            ("get_world_properties", "GetWorldProperties", self._get_world_properties),
        ):
            self._advertise(name, f"gazebo_msgs/{kind}", report_errors(answer))
        GazeboForces(self._bridge, self._simulation)

    def _advertise(self, name: str, service_type: str, answer: object) -> int:
        server: int = self._bridge.advertise_service(
            f"/gazebo/{name}", service_type, answer, _core.messages.TimeForm.FLOAT
        )
        return server

    def _spawn(self, request: Message) -> Message:
        if not request["model_xml"].strip():
            raise ValueError("model_xml is empty: it must be the text of a model in SDFormat or URDF")
        pose = _pose(request["initial_pose"])
        frame = find_frame(self._world, request["reference_frame"])
        if frame is not None:
            pose = self._world.pose_from(pose, frame)
        namespace = request["robot_namespace"]
        self._simulation.add_model(
            request["model_xml"],
            name=request["model_name"],
            position=pose[:3],
            orientation=pose[3:],
            plugin_parameters={"robotNamespace": namespace} if namespace else {},
        )
        return {"status_message": "SpawnModel: Successfully spawned entity"}

    def _delete(self, request: Message) -> Message:
        self._host.remove_model(find_entity(self._world, request["model_name"], "model"))
        return {"status_message": "DeleteModel: successfully deleted model"}

    def _get_model_state(self, request: Message) -> Message:
        model = find_entity(self._world, request["model_name"], "model")
        header = {"stamp": self._simulation.state_time, "frame_id": request["relative_entity_name"]}
        state = self._state(model, request["relative_entity_name"])
        return {"header": header, **state, "status_message": "GetModelState: got properties"}

    def _get_link_state(self, request: Message) -> Message:
        link = find_entity(self._world, request["link_name"], "link")
        state = {**request, **self._state(link, request["reference_frame"])}
        return {"link_state": state, "status_message": "GetLinkState: got state"}

    def _set_model_state(self, request: Message) -> Message:
        state = request["model_state"]
        self._set_state(find_entity(self._world, state["model_name"], "model"), state)
        return {"status_message": "SetModelState: set model state done"}

    def _set_link_state(self, request: Message) -> Message:
        state = request["link_state"]
        self._set_state(find_entity(self._world, state["link_name"], "link"), state)
        return {"status_message": "SetLinkState: success"}

    def _get_world_properties(self, request: Message) -> Message:
        return {
            "sim_time": self._simulation.state_time,
            "model_names": [self._world.name(model) for model in self._world.models],
            "rendering_enabled": True,
            "status_message": "GetWorldProperties: got properties",
        }

    def _state(self, handle: int, frame: str) -> Message:
        pose, linear, angular = state_in(self._world, handle, find_frame(self._world, frame))
        return {
            "pose": pose_message(pose),
            "twist": twist_message(linear, angular),
        }

    def _set_state(self, handle: int, state: Message) -> None:
        linear, angular = (vector_values(state["twist"][part]) for part in ("linear", "angular"))
        frame = find_frame(self._world, state["reference_frame"])
        self._world.set_state(handle, *state_from(self._world, _pose(state["pose"]), linear, angular, frame))


def _pose(message: Message) -> Sequence[float]:
    """Return a normalized pose. As in Gazebo, a quaternion of zeros means no rotation."""
    values = pose_values(message)
    length = math.hypot(*values[3:])
    return [*values[:3], *(value / length for value in values[3:])] if length else [*values[:3], 0.0, 0.0, 0.0, 1.0]
