# SPDX-License-Identifier: BSD-3-Clause
"""Odometry of drives: nav_msgs/Odometry and the transform from its frame to the robot's."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

from bubblesim._core.reading_messages import odometry
from bubblesim.controllers.planar_motion import Pose2D, Velocity
from bubblesim.gazebo_plugins.plugin import Plugin
from bubblesim.geometry.rotations import heading_of, quaternion_of_heading

UNKNOWN = 1e12  # variance of values that wheels cannot measure: height, roll and pitch
SOURCES = {"encoder": "encoder", "world": "world", "0": "encoder", "1": "world"}


@dataclass(frozen=True)
class Motion:
    """Pose in the odometry frame, and velocity along the robot's axes."""

    pose: Sequence[float]  # x, y, z, qx, qy, qz, qw
    forward: float  # m/s
    leftward: float  # m/s
    turning: float  # rad/s, to the left


def motion_in_world(world: Any, model: int) -> Motion:
    """Return the true motion of a model."""
    pose = world.pose(model)
    (x, y, _), (_, _, turning) = world.velocity(model)
    yaw = heading_of(*pose[3:])
    cos, sin = math.cos(yaw), math.sin(yaw)
    return Motion(pose, cos * x + sin * y, cos * y - sin * x, turning)


def motion_on_plane(pose: Pose2D, velocity: Velocity) -> Motion:
    """Return the motion computed from wheel encoders."""
    return Motion([pose.x, pose.y, 0.0, *quaternion_of_heading(pose.heading)], velocity.linear, 0.0, velocity.angular)


def variances(x: float, y: float, yaw: float) -> tuple[float, ...]:
    """Return the variances of x, y, z, roll, pitch and yaw; those that are not given are UNKNOWN."""
    return (x, y, UNKNOWN, UNKNOWN, UNKNOWN, yaw)


class Odometry:
    """The odometry topic and transform of a drive."""

    def __init__(
        self,
        plugin: Plugin,
        *,
        topic: str | None,
        frame: str,
        base_frame: str,
        transform: bool,
        pose_variances: Sequence[float],
        velocity_variances: Sequence[float] = (0.0,) * 6,
    ) -> None:
        """With ``topic`` None only the transform is published."""
        self._plugin = plugin
        self._publisher = None if topic is None else plugin.advertise(topic, "nav_msgs/Odometry", 1)
        self._frame = frame
        self._base_frame = base_frame
        self._transform = transform
        self._variances = pose_variances, velocity_variances

    def publish(self, motion: Motion) -> None:
        """Publish the motion of this step."""
        plugin = self._plugin
        header = plugin.header(self._frame)
        if self._transform:
            plugin.context.transforms.add(header, self._base_frame, motion.pose)
        if self._publisher is None or not plugin.is_needed(self._publisher):
            return
        velocity = (motion.forward, motion.leftward, 0.0), (0.0, 0.0, motion.turning)
        message = odometry(header, self._base_frame, motion.pose, *velocity, *self._variances)
        plugin.bridge.publish(self._publisher, message)
