# SPDX-License-Identifier: BSD-3-Clause
"""gazebo_ros_openni_kinect and gazebo_ros_depth_camera: depth images and point clouds."""

from __future__ import annotations

import math
from typing import Any

from bubblesim._core.reading_messages import camera_cloud, depth_image
from bubblesim.gazebo_plugins.plugin import PluginContext
from bubblesim.gazebo_plugins.sensors.camera import Camera


class DepthCamera(Camera):
    """Depths outside the cut-offs are NaN; points are in the optical frame: z forward, x to the right."""

    image_topic = "ir/image_raw"
    info_topic = "ir/camera_info"
    farthest = math.inf  # m, default of the plugin's parameter

    def __init__(self, context: PluginContext) -> None:
        """Read the parameters."""
        super().__init__(context)
        p = self.parameters
        self._cutoffs = p.number("pointCloudCutoff", 0.4), p.number("pointCloudCutoffMax", self.farthest)
        p.check()
        self._depth = self.advertise_more(p.text("depthImageTopicName", "depth/image_raw"), "sensor_msgs/Image")
        self.advertise_more_infos(p.text("depthImageCameraInfoTopicName", "depth/camera_info"))
        self._points = self.advertise_more(p.text("pointCloudTopicName", "points"), "sensor_msgs/PointCloud2")

    def publish_image(self, image: Any, header: Any) -> None:
        """Publish the topics that have subscribers."""
        super().publish_image(image, header)
        if self.is_needed(self._depth):
            self.bridge.publish(self._depth, depth_image(header, image, self._cutoffs))
        if self.is_needed(self._points):
            self.bridge.publish(self._points, camera_cloud(header, image, self._cutoffs, optical=True))


class OpenniKinect(DepthCamera):
    """A Kinect: maximum depth 5 m."""

    farthest = 5.0
