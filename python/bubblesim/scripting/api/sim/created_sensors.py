# SPDX-License-Identifier: BSD-3-Clause
"""`sim` functions that create sensors."""

from __future__ import annotations

from typing import Any

from bubblesim.scene_state.created_sensors import proximity_sensor, vision_sensor
from bubblesim.scripting.api.differences import differs
from bubblesim.scripting.api.kinds import Integers, Numbers
from bubblesim.scripting.api.sim.created_objects import CreatedObjectFunctions
from bubblesim.scripting.api.sim.sensor_changes import SensorChangeFunctions

_PERSPECTIVE = 2  # option of createVisionSensor


class CreatedSensorFunctions(CreatedObjectFunctions, SensorChangeFunctions):
    """A created sensor looks along the z axis of its object, which can be moved and attached to others; on a body it
    moves along. It stays until it is removed or the scene is closed."""

    @differs("all options and parameters count; here the range, sizes and angles")
    def createProximitySensor(
        self, kind: int, subtype: int, options: int, integers: Integers, floats: Numbers, more: Any = None
    ) -> int:
        """Create a proximity sensor at the origin and return its handle; not in sysCall_sensing.

        ``kind``: sim.proximitysensor_pyramid_subtype, cylinder, disc, cone or ray. ``floats``: offset, range, sizes
        near x, y and far x, y, gap, radius near and far (m), angle, largest angle to the surface (rad, 0: none),
        smallest distance (m); the others, ``subtype``, ``options`` and ``integers`` have no effect."""
        return self._add_sensor(proximity_sensor(kind, floats))

    @differs("all options and parameters count; here resolution, planes, angle and perspective")
    def createVisionSensor(self, options: int, integers: Integers, floats: Numbers, more: Any = None) -> int:
        """Create a camera at the origin and return its handle; not in sysCall_sensing.

        ``options`` 2: in perspective. ``integers``: width and height in pixels. ``floats``: near and far plane (m), and
        the angle of the larger side (rad), without perspective its width (m); the others have no effect."""
        if len(integers) < 2:
            raise ValueError(f"a vision sensor needs width and height in pixels, found {len(integers)} numbers")
        rate = 1 / float(self._simulation.time_step)
        is_perspective = bool(options & _PERSPECTIVE)
        return self._add_sensor(vision_sensor(integers[0], integers[1], floats, rate, is_perspective=is_perspective))
