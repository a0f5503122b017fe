# SPDX-License-Identifier: BSD-3-Clause
"""`sim` functions that read sensors."""

from __future__ import annotations

from bubblesim._core import measure_proximity, read_imu, read_proximity, reading_time
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

    def checkProximitySensor(self, sensor: Handle, entity: Handle) -> Reading:
        """Measure now; a result of 0 also when the nearest thing does not belong to ``entity``.

        Any object takes part for sim.handle_all.
        """
        reading: Reading = measure_proximity(self._simulation, self._resolve(sensor))
        seen = reading[3]
        if seen < 0 or entity == self.handle_all or self._belongs(seen, self._resolve(entity)):
            return reading
        return 0, 0.0, [0.0, 0.0, 0.0], -1, [0.0, 0.0, 0.0]

    def getReadingTime(self, sensor: Handle) -> float:
        """Simulated seconds at which the sensor measured what it is read as now."""
        return float(reading_time(self._simulation, self._resolve(sensor)))

    def readImu(self, sensor: Handle) -> tuple[list[float], list[float], list[float]]:
        """Orientation (x, y, z, w), angular velocity (rad/s) and linear acceleration (m/s^2), in the sensor's frame."""
        reading = read_imu(self._simulation, self._resolve(sensor))
        return reading.orientation.tolist(), reading.angular_velocity.tolist(), reading.linear_acceleration.tolist()

    def _belongs(self, handle: int, to: int) -> bool:
        """Whether an object is, or lies below, another one."""
        while handle >= 0 and handle != to:
            handle = int(self._world.parent(handle))
        return handle >= 0
