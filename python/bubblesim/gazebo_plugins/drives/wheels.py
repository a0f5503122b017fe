# SPDX-License-Identifier: BSD-3-Clause
"""Wheels as drives know them: joints with motors, whose states are told."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from bubblesim._core import MotorMode
from bubblesim.gazebo_plugins.device import Device, Message


def drive_by_velocity(world: Any, joints: Sequence[int], torque: float | None = None) -> None:
    """Have joints hold a velocity, 0 to begin with, by a motor of a torque (N m), None for the joint's."""
    for joint in joints:
        world.set_motor_mode(joint, MotorMode.VELOCITY)
        if torque is not None:
            world.set_max_force(joint, torque)
        world.set_target_velocity(joint, 0.0)


def wheel_radius(device: Device, joint: int) -> float | None:
    """Of the sphere or cylinder that the child of a joint collides as; None when it has neither."""
    path = device.world.path(device.world.joint_links(joint)[1])
    shapes = [shape for shape in device.simulation.collisions if shape.object_path == path]
    return max((shape.size[0] for shape in shapes if shape.kind in ("sphere", "cylinder")), default=None)


def joint_states(device: Device, joints: Sequence[int], *, efforts: bool = False) -> Message:
    """A sensor_msgs/JointState of this step; the effort is the motor's limit."""
    world = device.world
    return {
        "header": device.header(""),
        "name": [world.name(joint) for joint in joints],
        "position": [world.joint_position(joint) for joint in joints],
        "velocity": [world.joint_velocity(joint) for joint in joints],
        "effort": [world.max_force(joint) for joint in joints] if efforts else [],
    }


class WheelTopics:
    """What a drive tells of its wheels on demand: joint_states, and the wheels' transforms."""

    def __init__(self, device: Device, joints: Sequence[int], *, efforts: bool = False) -> None:
        """Read the parameters publishWheelJointState and publishWheelTF."""
        self._device = device
        self._joints = joints
        self._efforts = efforts
        self._transforms = device.parameters.flag("publishWheelTF", default=False)
        self._publisher: int | None = None
        if device.parameters.flag("publishWheelJointState", default=False):
            self._publisher = device.advertise("joint_states", "sensor_msgs/JointState", 1000)

    def publish(self) -> None:
        """Tell what holds in this step."""
        device, world = self._device, self._device.world
        if self._publisher is not None and device.wanted(self._publisher):
            message = joint_states(device, self._joints, efforts=self._efforts)
            device.bridge.publish(self._publisher, message)
        if self._transforms:
            for joint in self._joints:
                parent, child = world.joint_links(joint)
                header = device.header(device.frame(world.name(parent)))
                device.context.transforms.add(header, device.frame(world.name(child)), world.pose_in(child, parent))
