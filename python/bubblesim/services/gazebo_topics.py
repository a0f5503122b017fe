# SPDX-License-Identifier: BSD-3-Clause
"""The topics /gazebo/model_states and /gazebo/link_states."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from bubblesim.ros_messages import pose_message, vector_message
from bubblesim.services.gazebo_names import links_of


class GazeboTopics:
    """Advertised during the lifetime of the bridge."""

    def __init__(self, bridge: Any, world: Any) -> None:
        """Advertise the topics."""
        self._bridge = bridge
        self._world = world
        self._models = bridge.advertise("/gazebo/model_states", "gazebo_msgs/ModelStates", 1)
        self._links = bridge.advertise("/gazebo/link_states", "gazebo_msgs/LinkStates", 1)

    def publish(self) -> None:
        """Publish all poses and velocities at the end of a step, if there are subscribers."""
        name = self._world.name
        if self._bridge.wants_messages(self._models):
            models = self._world.models
            self._bridge.publish(self._models, self._states(models, [name(model) for model in models]))
        if self._bridge.wants_messages(self._links):
            links = [(model, link) for model in self._world.models for link in links_of(self._world, model)]
            names = [f"{name(model)}::{name(link)}" for model, link in links]
            self._bridge.publish(self._links, self._states([link for _, link in links], names))

    def _states(self, handles: Sequence[int], names: list[str]) -> dict[str, Any]:
        twists = [map(vector_message, self._world.velocity(handle)) for handle in handles]
        return {
            "name": names,
            "pose": [pose_message(self._world.pose(handle)) for handle in handles],
            "twist": [dict(zip(("linear", "angular"), twist, strict=True)) for twist in twists],
        }
