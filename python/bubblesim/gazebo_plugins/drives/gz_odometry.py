# SPDX-License-Identifier: BSD-3-Clause
"""The odometry that gz-sim's drives tell, by the names and defaults of its topics."""

from __future__ import annotations

from bubblesim.gazebo_plugins.device import Device
from bubblesim.gazebo_plugins.drives.odometry import Odometry, covariance


def drive_odometry(device: Device) -> Odometry:
    """Of a drive; its transform goes to /tf."""
    p = device.parameters
    model = device.world.name(device.context.model)
    return Odometry(
        device,
        topic=p.text("odom_topic", f"/model/{model}/odometry"),
        frame=p.text("frame_id", f"{model}/odom"),
        base_frame=p.text("child_frame_id", f"{model}/base_link"),
        transform=True,
        pose_covariance=covariance(1e-5, 1e-5, 1e-3),
    )
