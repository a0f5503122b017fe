# SPDX-License-Identifier: BSD-3-Clause
"""Wheels of drives: motors of the joints, and topics with their states."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from bubblesim._core import MotorMode
from bubblesim._core.reading_messages import joint_state
from bubblesim.gazebo_plugins.plugin import Plugin


def drive_by_velocity(world: Any, joints: Sequence[int], torque: float | None = None) -> None:
    """Set joints to velocity control with target 0; ``torque`` is the motor's limit (N m), None for the joint's."""
    for joint in joints:
        world.set_motor_mode(joint, MotorMode.VELOCITY)
        if torque is not None:
            world.set_max_force(joint, torque)
        world.set_target_velocity(joint, 0.0)


def wheel_radius(plugin: Plugin, joint: int) -> float | None:
    """Return the radius of the sphere or cylinder with which a joint's child collides; None if there is none."""
    path = plugin.world.path(plugin.world.joint_links(joint)[1])
    shapes = [shape for shape in plugin.simulation.collisions if shape.object_path == path]
    return max((shape.size[0] for shape in shapes if shape.kind in ("sphere", "cylinder")), default=None)


class WheelTopics:
    """Optional topics of a drive's wheels: joint_states, and the wheels' transforms."""

    def __init__(self, plugin: Plugin, joints: Sequence[int]) -> None:
        """Read the parameters publishWheelJointState and publishWheelTF."""
        self._plugin = plugin
        self._joints = joints
        self._transforms = plugin.parameters.flag("publishWheelTF", default=False)
        self._publisher: int | None = None
        if plugin.parameters.flag("publishWheelJointState", default=False):
            self._publisher = plugin.advertise("joint_states", "sensor_msgs/JointState", 1000)

    def publish(self) -> None:
        """Publish the states of this step."""
        plugin, world = self._plugin, self._plugin.world
        if self._publisher is not None and plugin.is_needed(self._publisher):
            plugin.bridge.publish(self._publisher, joint_state(world, plugin.header(""), self._joints))
        if self._transforms:
            for joint in self._joints:
                parent, child = world.joint_links(joint)
                header = plugin.header(plugin.frame(world.name(parent)))
                plugin.context.transforms.add(header, plugin.frame(world.name(child)), world.pose_in(child, parent))
