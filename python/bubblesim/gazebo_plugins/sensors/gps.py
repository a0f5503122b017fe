# SPDX-License-Identifier: BSD-3-Clause
"""hector_gazebo_plugins' gazebo_ros_gps: position of a link on the Earth."""

from __future__ import annotations

import math

from bubblesim._core.reading_messages import nav_sat_fix, vector
from bubblesim.gazebo_plugins.plugin import PluginContext
from bubblesim.gazebo_plugins.sensors.hector import HectorSensor
from bubblesim.gazebo_plugins.sensors.noise import Noise

# WGS 84
_EQUATORIAL_RADIUS = 6378137.0  # m
_ECCENTRICITY_SQUARED = 6.69437999014e-3


class Gps(HectorSensor):
    """Parameters and defaults are hector's: with a <referenceHeading> of 0, x is north and y west."""

    default_rate = 4.0

    def __init__(self, context: PluginContext) -> None:
        """Read the parameters; angles in degrees."""
        super().__init__(context)
        p = self.parameters
        self._latitude = p.number("referenceLatitude", 49.9)
        self._longitude = p.number("referenceLongitude", 8.9)
        self._altitude = p.number("referenceAltitude", 0.0)
        self._heading = math.radians(p.number("referenceHeading", 0.0))
        self._status = int(p.number("status", 0)), int(p.number("service", 1))
        self._velocity_noise = Noise(self, *p.deviations("velocityGaussianNoise"))
        p.ignore("velocityOffset", "velocityDrift", "velocityDriftFrequency")
        p.check()
        self._fix = self.advertise(p.text("topicName", "fix"), "sensor_msgs/NavSatFix", 10)
        self._velocity = self.advertise(p.text("velocityTopicName", "fix_velocity"), "geometry_msgs/Vector3Stamped", 10)

    def reset(self) -> None:
        """Reset rate and noise."""
        super().reset()
        self._velocity_noise.reset()

    def publish(self) -> None:
        """Publish position and velocity."""
        if not self.is_due(self._fix, self._velocity):
            return
        header = self.header(self._frame)
        x, y, z = self._noise.on(self.world.pose(self._link)[:3])
        north, west = self._turned(x, y)
        # Radii at the reference: of curvature along the meridian, and of the parallel.
        squeezed = 1 - _ECCENTRICITY_SQUARED * math.sin(math.radians(self._latitude)) ** 2
        across = _EQUATORIAL_RADIUS / math.sqrt(squeezed)
        meridian = across * (1 - _ECCENTRICITY_SQUARED) / squeezed
        parallel = across * math.cos(math.radians(self._latitude))
        latitude = self._latitude + math.degrees(north / meridian)
        longitude = self._longitude - math.degrees(west / parallel)
        place = latitude, longitude, self._altitude + z
        self.bridge.publish(self._fix, nav_sat_fix(header, *place, *self._status, self._noise.variances(3)))
        vx, vy, vz = self._velocity_noise.on(self.world.velocity(self._link)[0])
        self.bridge.publish(self._velocity, vector(header, (*self._turned(vx, vy), vz)))

    def _turned(self, x: float, y: float) -> tuple[float, float]:
        """Return the north and west components of a vector along x and y."""
        cos, sin = math.cos(self._heading), math.sin(self._heading)
        return cos * x + sin * y, -sin * x + cos * y
