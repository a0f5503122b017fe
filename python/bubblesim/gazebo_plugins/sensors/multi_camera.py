# SPDX-License-Identifier: BSD-3-Clause
"""gazebo_ros_multicamera: the cameras of one sensor, such as left and right of a stereo head."""

from __future__ import annotations

from bubblesim.gazebo_plugins.plugin import PluginContext
from bubblesim.gazebo_plugins.sensors.camera import Camera

_SIDES = ("left", "right")


class MultiCamera(Camera):
    """One for each <camera>, which is a sensor SENSOR_CAMERA here.

    As in Gazebo, its topics are below cameraName/left or cameraName/right, depending on the name of the <camera>, and
    <hackBaseline> applies to the right one.
    """

    def __init__(self, context: PluginContext) -> None:
        """Read the parameters."""
        super().__init__(context)
        if self._side() == "left":
            self.info.baseline = 0.0

    def below_camera(self, name: str) -> str:
        """Return a topic of the camera's side."""
        side = self._side()
        return super().below_camera(name if name.startswith("/") or not side else f"{side}/{name}")

    def _side(self) -> str:
        camera = self.world.name(self.context.owner)
        side = max(_SIDES, key=camera.rfind)  # the camera's name follows that of the sensor
        return side if side in camera else ""
