# SPDX-License-Identifier: BSD-3-Clause
"""`sim` functions that read sensors."""

from __future__ import annotations

from bubblesim._core import measure_proximity, read_imu, read_proximity
from bubblesim.scripting.context import ApiContext
from bubblesim.scripting.kinds import Handle

Reading = tuple[int, float, list[float], int, list[float]]


class SensorFunctions(ApiContext):
    """Proximity sensors give (result, distance, point, object, normal) in the sensor's frame, metres."""

    def readProximitySensor(self, sensor: Handle) -> Reading:
        """What the sensor measured last; result 0 and distance 0.0 for nothing."""
        reading: Reading = read_proximity(self._simulation, self._resolve(sensor))
        return reading

    def handleProximitySensor(self, sensor: Handle) -> Reading:
        """Measure now."""
        reading: Reading = measure_proximity(self._simulation, self._resolve(sensor))
        return reading

    def readImu(self, sensor: Handle) -> tuple[list[float], list[float], list[float]]:
        """Orientation (x, y, z, w), angular velocity (rad/s) and linear acceleration (m/s^2), in the sensor's frame."""
        reading = read_imu(self._simulation, self._resolve(sensor))
        return reading.orientation.tolist(), reading.angular_velocity.tolist(), reading.linear_acceleration.tolist()
