# SPDX-License-Identifier: BSD-3-Clause
"""gazebo_ros_multicamera: the cameras of one sensor, such as the left and right one of a stereo head."""

from __future__ import annotations

from bubblesim.gazebo_plugins.device import PluginContext
from bubblesim.gazebo_plugins.sensors.camera import Camera

_SIDES = ("left", "right")


class MultiCamera(Camera):
    """One for each <camera>, which is a sensor SENSOR_CAMERA here.

    As in Gazebo its topics lie below cameraName/left or cameraName/right, by what the name of the <camera> holds, and
    <hackBaseline> is that of the right one.
    """

    def __init__(self, context: PluginContext) -> None:
        """Read the parameters."""
        super().__init__(context)
        if self._side() == "left":
            self.info.baseline = 0.0

    def below_camera(self, name: str) -> str:
        """A topic of the camera's side."""
        side = self._side()
        return super().below_camera(name if name.startswith("/") or not side else f"{side}/{name}")

    def _side(self) -> str:
        camera = self.world.name(self.context.owner)
        side = max(_SIDES, key=camera.rfind)  # the camera's name follows that of the sensor
        return side if side in camera else ""
