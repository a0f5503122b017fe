# SPDX-License-Identifier: BSD-3-Clause
"""Camera intrinsics: sensor_msgs/CameraInfo."""

from __future__ import annotations

import math
from typing import Any

from bubblesim._core.reading_messages import camera_info
from bubblesim.gazebo_plugins.parameters import Parameters


class CameraInfo:
    """Intrinsics of a pinhole camera; the parameters are those of gazebo_ros_pkgs."""

    def __init__(self, parameters: Parameters) -> None:
        """Read the parameters; a centre or focal length of 0 is computed from the image size."""
        p = parameters
        self._centre = p.number("Cx", 0.0), p.number("Cy", 0.0)
        self._focal_length = p.number("focalLength", 0.0)
        self.baseline = p.number("hackBaseline", 0.0)
        names = ("distortionK1", "distortionK2", "distortionT1", "distortionT2", "distortionK3")
        self._distortion = [p.number(name, 0.0) for name in names]
        p.ignore("CxPrime", "borderCrop", "distortion_k1", "autoDistortion")

    def message(self, header: Any, width: int, height: int, horizontal_fov: float) -> Any:
        """Return the message for this image size."""
        f = self._focal_length or width / (2 * math.tan(horizontal_fov / 2))
        cx, cy = self._centre[0] or (width + 1) / 2, self._centre[1] or (height + 1) / 2
        return camera_info(header, width, height, f, cx, cy, self.baseline, self._distortion)
