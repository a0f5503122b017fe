# SPDX-License-Identifier: BSD-3-Clause
"""The services of gazebo_ros about the joints and parts of models, and their answers."""

from __future__ import annotations

from typing import Any

from bubblesim import _core
from bubblesim.services.answers import Message, report_errors
from bubblesim.services.gazebo_names import find_entity

_TYPES = {"revolute": 0, "continuous": 1, "prismatic": 2, "fixed": 3, "ball": 4, "universal": 5}


class GazeboProperties:
    """Advertised during the lifetime of the bridge."""

    def __init__(self, bridge: Any, simulation: Any) -> None:
        """Advertise the services below /gazebo."""
        self._world = simulation.world
        for name, kind, answer in (
            ("set_model_configuration", "SetModelConfiguration", self._set_configuration),
            ("get_model_properties", "GetModelProperties", self._get_model),
            ("get_joint_properties", "GetJointProperties", self._get_joint),
        ):
            bridge.advertise_service(
                f"/gazebo/{name}", f"gazebo_msgs/{kind}", report_errors(answer), _core.messages.TimeForm.FLOAT
            )

    def _set_configuration(self, request: Message) -> Message:
        model = find_entity(self._world, request["model_name"], "model")
        names, positions = request["joint_names"], request["joint_positions"]
        if len(names) != len(positions):
            raise ValueError(f"{len(names)} joint names and {len(positions)} positions")
        joints = {self._world.name(joint): joint for joint in self._world.parts(model, "joint")}
        if unknown := [name for name in names if name not in joints]:
            raise LookupError(f"{request['model_name']} has no joint {', '.join(unknown)}; it has {', '.join(joints)}")
        for name, position in zip(names, positions, strict=True):
            self._world.set_joint_position(joints[name], position)
        return {"status_message": "SetModelConfiguration: success"}

    def _get_model(self, request: Message) -> Message:
        world = self._world
        model = find_entity(world, request["model_name"], "model")
        links = [world.name(link) for link in world.parts(model, "link")]
        return {
            "canonical_body_name": links[0] if links else "",
            "body_names": links,
            "joint_names": [world.name(joint) for joint in world.parts(model, "joint")],
            "child_model_names": [world.name(inner) for inner in world.parts(model, "model") if inner != model],
            "is_static": world.is_static(model),
            "status_message": "GetModelProperties: got properties",
        }

    def _get_joint(self, request: Message) -> Message:
        world = self._world
        joint = find_entity(world, request["joint_name"], "joint")
        axes = range(world.joint_axes(joint))
        return {
            "type": _TYPES.get(world.joint_type(joint), 0),
            "position": [world.joint_position(joint, axis) for axis in axes],
            "rate": [world.joint_velocity(joint, axis) for axis in axes],
            "status_message": "GetJointProperties: got properties",
        }
