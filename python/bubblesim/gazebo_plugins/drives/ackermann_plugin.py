# SPDX-License-Identifier: BSD-3-Clause
"""The common part of the plugins that drive a car."""

from __future__ import annotations

from bubblesim.gazebo_plugins.drives.ackermann_wheels import AckermannWheels
from bubblesim.gazebo_plugins.drives.odometry import Odometry, motion_in_world
from bubblesim.gazebo_plugins.plugin import Plugin
from bubblesim.gazebo_plugins.rate import Rate


class AckermannPlugin(Plugin):
    """Commands the wheels of a car and publishes its exact odometry; subclasses set the attributes in ``__init__``."""

    _wheels: AckermannWheels
    _odometry: Odometry
    _rate: Rate  # of the odometry
    _max_speed: float  # m/s
    _max_steering: float  # rad

    def steer(self, speed: float, angle: float) -> None:
        """Set speed (m/s) and steering angle (rad, to the left), each within its limit."""
        limited = max(-self._max_speed, min(speed, self._max_speed))
        self._wheels.command(limited, max(-self._max_steering, min(angle, self._max_steering)))

    def reset(self) -> None:
        """Stop and steer straight ahead."""
        self._wheels.reset()
        self._rate.reset()

    def publish(self) -> None:
        """Publish the odometry."""
        if self._rate.due():
            self._odometry.publish(motion_in_world(self.world, self.context.model))
