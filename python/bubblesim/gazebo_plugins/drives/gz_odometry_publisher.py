# SPDX-License-Identifier: BSD-3-Clause
"""gz-sim's OdometryPublisher: the true pose and velocity of a model."""

from __future__ import annotations

from bubblesim.gazebo_plugins.drives.odometry import Odometry, motion_in_world, variances
from bubblesim.gazebo_plugins.plugin import Plugin, PluginContext
from bubblesim.gazebo_plugins.rate import Rate


class GzOdometryPublisher(Plugin):
    """Topics have its names and defaults; the transform is published on /tf and <tf_topic> is ignored."""

    def __init__(self, context: PluginContext) -> None:
        """Read the parameters."""
        super().__init__(context)
        p = self.parameters
        model = self.world.name(context.model)
        self._rate = Rate(p.number("odom_publish_frequency", 50.0, least=0.0), self.simulation)
        p.ignore("tf_topic", "dimensions", "odom_covariance_topic", "xyz_offset", "rpy_offset", "gaussian_noise")
        p.check()
        self._odometry = Odometry(
            self,
            topic=p.text("odom_topic", f"/model/{model}/odometry"),
            frame=p.text("odom_frame", f"{model}/odom"),
            base_frame=p.text("robot_base_frame", f"{model}/base_footprint"),
            transform=True,
            pose_variances=variances(0.0, 0.0, 0.0),
        )

    def reset(self) -> None:
        """Reset the rate."""
        self._rate.reset()

    def publish(self) -> None:
        """Publish pose and velocity."""
        if self._rate.due():
            self._odometry.publish(motion_in_world(self.world, self.context.model))
