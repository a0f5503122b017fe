# SPDX-License-Identifier: BSD-3-Clause
"""gazebo_ros_openni_kinect and gazebo_ros_depth_camera: depth images and point clouds."""

from __future__ import annotations

from typing import Any

import numpy as np

from bubblesim.gazebo_plugins.plugin import Message, PluginContext
from bubblesim.gazebo_plugins.sensors.camera import Camera, image_message

Array = np.ndarray[Any, Any]

_FLOAT32 = 7  # sensor_msgs/PointField
_POINT = 32  # bytes per point: x, y and z in the first 12, the colour in 4 from the 16th on, as in PCL
_FIELDS = [
    {"name": name, "offset": offset, "datatype": _FLOAT32, "count": 1}
    for name, offset in (("x", 0), ("y", 4), ("z", 8), ("rgb", 16))
]


class DepthCamera(Camera):
    """Depths outside the cut-offs are NaN; points are in the optical frame: z forward, x to the right."""

    image_topic = "ir/image_raw"
    info_topic = "ir/camera_info"
    farthest = np.inf  # m, default of the plugin's parameter

    def __init__(self, context: PluginContext) -> None:
        """Read the parameters."""
        super().__init__(context)
        p = self.parameters
        self._cutoffs = p.number("pointCloudCutoff", 0.4), p.number("pointCloudCutoffMax", self.farthest)
        p.check()
        self._depth = self.advertise_more(p.text("depthImageTopicName", "depth/image_raw"), "sensor_msgs/Image")
        self.advertise_more_infos(p.text("depthImageCameraInfoTopicName", "depth/camera_info"))
        self._points = self.advertise_more(p.text("pointCloudTopicName", "points"), "sensor_msgs/PointCloud2")
        self._cloud = DepthCloud(optical=True)

    def publish_image(self, image: Any, header: Message) -> None:
        """Publish the topics that have subscribers."""
        super().publish_image(image, header)
        if not (self.is_needed(self._depth) or self.is_needed(self._points)):
            return
        near, far = self._cutoffs
        if self.is_needed(self._depth):
            depth = np.where((image.depth > near) & (image.depth < far), image.depth, np.float32(np.nan))
            self.bridge.publish(self._depth, {"header": header, **image_message(depth, "32FC1")})
        if self.is_needed(self._points):
            self.bridge.publish(self._points, {"header": header, **self._cloud.message(image, near, far)})


class OpenniKinect(DepthCamera):
    """A Kinect: maximum depth 5 m."""

    farthest = 5.0


class DepthCloud:
    """Computes point clouds from the images of one camera."""

    def __init__(self, *, optical: bool) -> None:
        """``optical``: axes with z forward and x to the right; else with x forward and y to the left."""
        self._optical = optical
        self._points: Array | None = None  # memory for all messages: fresh memory takes longer than the points

    def message(self, image: Any, near: float = -np.inf, far: float = np.inf) -> Message:
        """Return a sensor_msgs/PointCloud2 without its header; it is valid until the next one.

        Points whose depth is not between ``near`` and ``far``, in metres, are NaN.
        """
        height, width = image.depth.shape
        if self._points is None:
            self._points = np.empty((height, width, _POINT // 4), np.float32)
        dense = image.fill_cloud(self._points, near, far, self._optical)
        return {
            "height": height,
            "width": width,
            "fields": _FIELDS,
            "is_bigendian": False,
            "point_step": _POINT,
            "row_step": _POINT * width,
            "data": self._points.view(np.uint8),
            "is_dense": dense,
        }
