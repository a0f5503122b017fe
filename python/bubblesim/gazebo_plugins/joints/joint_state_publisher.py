# SPDX-License-Identifier: BSD-3-Clause
"""gazebo_ros_joint_state_publisher, and gz-sim's JointStatePublisher."""

from __future__ import annotations

from bubblesim._core.reading_messages import joint_state
from bubblesim.gazebo_plugins.plugin import Plugin, PluginContext
from bubblesim.gazebo_plugins.rate import Rate


class JointStatePublisher(Plugin):
    """Parameters and defaults are those of gazebo_ros_pkgs; without <jointName> all movable joints are published."""

    names = "jointName"

    def __init__(self, context: PluginContext) -> None:
        """Read the parameters."""
        super().__init__(context)
        p = self.parameters
        self.enter_namespace(of_model=True)
        self._joints = [self.joint_named(name, self.names) for name in p.names(self.names)] or self._moving_joints()
        self._rate = Rate(p.number("updateRate", 100.0, least=0.0), self.simulation)
        p.check()
        self._publisher = self.advertise(self.default_topic(), "sensor_msgs/JointState", 1000)

    def _moving_joints(self) -> list[int]:
        joints = [part for part in self.parts_of_model() if self.world.kind(part) == "joint"]
        return [joint for joint in joints if self.world.joint_axes(joint) > 0]

    def default_topic(self) -> str:
        """Return the topic; subclasses read it from a parameter."""
        return "joint_states"

    def reset(self) -> None:
        """Reset the rate."""
        self._rate.reset()

    def publish(self) -> None:
        """Publish the joints' states."""
        if self.is_needed(self._publisher) and self._rate.due():
            self.bridge.publish(self._publisher, joint_state(self.world, self.header(""), self._joints))


class GzJointStatePublisher(JointStatePublisher):
    """gz-sim's plugin; its topic contains the names of world and model."""

    names = "joint_name"

    def default_topic(self) -> str:
        """Return the topic, by default as in Gazebo's transport."""
        default = f"/world/{self.simulation.world_name}/model/{self.world.name(self.context.model)}/joint_state"
        return "/" + self.parameters.text("topic", default).lstrip("/")
