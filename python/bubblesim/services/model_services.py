# SPDX-License-Identifier: BSD-3-Clause
"""The services ~spawn_sdf and ~delete_object."""

from __future__ import annotations

from bubblesim import _core
from bubblesim.ros_messages import pose_values
from bubblesim.scripting.host.host import ScriptHost
from bubblesim.services.answers import Message, report_errors
from bubblesim.services.names import find_object


class ModelServices:
    """Advertised during the lifetime of the host's bridge."""

    def __init__(self, host: ScriptHost) -> None:
        """Advertise the services in the node's namespace."""
        self._host = host
        self._world = host.simulation.world
        assert host.bridge is not None
        for name, service_type, answer in (
            ("~spawn_sdf", "bubblesim_msgs/SpawnSdf", self._spawn),
            ("~delete_object", "bubblesim_msgs/DeleteObject", self._delete),
        ):
            host.bridge.advertise_service(name, service_type, report_errors(answer), _core.messages.TimeForm.FLOAT)

    def _spawn(self, request: Message) -> Message:
        pose = pose_values(request["pose"])
        if request["reference"]:
            pose = self._world.pose_from(pose, find_object(self._world, request["reference"]))
        self._host.simulation.add_model(request["sdf"], name=request["name"], position=pose[:3], orientation=pose[3:])
        return {}

    def _delete(self, request: Message) -> Message:
        self._host.remove_model(find_object(self._world, request["object"]))
        return {}
