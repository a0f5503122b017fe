# SPDX-License-Identifier: BSD-3-Clause
"""Odometry of gz-sim's drives, with the names and defaults of its topics."""

from __future__ import annotations

from bubblesim.gazebo_plugins.drives.odometry import Odometry, variances
from bubblesim.gazebo_plugins.plugin import Plugin


def drive_odometry(plugin: Plugin) -> Odometry:
    """Return the odometry of a drive; its transform is published on /tf."""
    p = plugin.parameters
    model = plugin.world.name(plugin.context.model)
    return Odometry(
        plugin,
        topic=p.text("odom_topic", f"/model/{model}/odometry"),
        frame=p.text("frame_id", f"{model}/odom"),
        base_frame=p.text("child_frame_id", f"{model}/base_link"),
        transform=True,
        pose_variances=variances(1e-5, 1e-5, 1e-3),
    )
