# SPDX-License-Identifier: BSD-3-Clause
"""`sim` functions that read sensors."""

from __future__ import annotations

import math
from typing import Any

from bubblesim._core import (
    measure_proximity,
    read_altimeter,
    read_contacts,
    read_force_torque,
    read_imu,
    read_magnetometer,
    read_navsat,
    read_proximity,
    reading_time,
)
from bubblesim.geometry import poses
from bubblesim.scripting.api.differences import differs
from bubblesim.scripting.api.kinds import Handle, Numbers
from bubblesim.scripting.api.sim.object_collections import CollectionFunctions

Reading = tuple[int, float, list[float], int, list[float]]

_NOTHING: Reading = (0, 0.0, [0.0, 0.0, 0.0], -1, [0.0, 0.0, 0.0])


class SensorFunctions(CollectionFunctions):
    """Proximity sensors return (result, distance, point, object, normal) in the sensor's frame, metres. They detect the
    nearest object if it belongs to sim.proxintparam_entity_to_detect, by default all but their own model."""

    @differs("the result is -1 before the first step; here it measures then")
    def readProximitySensor(self, sensor: Handle) -> Reading:
        """Return the last measurement; result 0 and distance 0.0 if nothing was detected."""
        sensor = self._sensor(sensor)
        return self._detected(read_proximity(self._simulation, sensor), sensor)

    @differs("with sim.handle_all, all sensors measure; here they do when they are due")
    def handleProximitySensor(self, sensor: Handle) -> Reading:
        """Measure now; for sim.handle_all, and handle_all_except_explicit, nothing: sensors measure when they are
        due."""
        if sensor in (self.handle_all, self.handle_all_except_explicit):
            return _NOTHING
        sensor = self._sensor(sensor)
        return self._detected(measure_proximity(self._simulation, sensor), sensor)

    def checkProximitySensor(self, sensor: Handle, entity: Handle) -> Reading:
        """Measure now; the result is 0 also if the nearest object does not belong to ``entity``.

        It is an object, a collection, or sim.handle_all.
        """
        reading: Reading = measure_proximity(self._simulation, self._sensor(sensor))
        return self._limited(reading, entity if entity == self.handle_all else self._resolve(entity))

    def checkProximitySensorEx(
        self, sensor: Handle, entity: Handle, mode: int = 0, threshold: float = 0.0, max_angle: float = 0.0
    ) -> Reading:
        """Measure now, as checkProximitySensor; a ``threshold`` above 0 is the smallest distance, m. The ``mode`` and
        the largest angle to the surface are those of the sensor."""
        reading = self.checkProximitySensor(sensor, entity)
        return reading if threshold <= 0 or reading[1] >= threshold else _NOTHING

    @differs("the nearest place of segments and triangles in its volume counts; here their corners within its range")
    def checkProximitySensorEx2(
        self,
        sensor: Handle,
        vertices: Numbers,
        item_type: int = 0,
        count: int = 1,
        mode: int = 0,
        threshold: float = 0.0,
        max_angle: float = 0.0,
    ) -> tuple[int, float, list[float], list[float]]:
        """Return result 1, distance, point and normal of the nearest of some points, segments or triangles
        (``item_type`` 0, 1, 2), by their corners in the world, that is within the range of the sensor along its axis;
        else result 0."""
        per_item = 3 * (item_type + 1)
        corners = vertices[: count * per_item]
        pose = self._tree.pose(self._resolve(sensor))
        low, high = self._world.sonar_limits(self._sensor(sensor))[:2]
        places = [corners[i : i + 3] for i in range(0, len(corners) - 2, 3)]
        looks = poses.inverse([float(part) for part in self._world.pose(self._sensor(sensor))])  # along x
        ahead = [place for place in places if poses.transform(looks, place)[0] > 0]
        points = [poses.transform(poses.inverse(pose), place) for place in ahead]
        seen = [point for point in points if low <= math.hypot(*point) <= high]
        if not seen:
            return 0, 0.0, [0.0, 0.0, 0.0], [0.0, 0.0, 0.0]
        nearest = min(seen, key=lambda point: math.hypot(*point))
        distance = math.hypot(*nearest)
        return 1, distance, nearest, [-part / distance for part in nearest]

    def getReadingTime(self, sensor: Handle) -> float:
        """Return the time, s, of the state that the last measurement shows; do not measure.

        Without readers it is the time at which the sensor was last due. A reading of this step is later than
        getSimulationTime in sysCall_sensing.
        """
        return float(reading_time(self._simulation, self._sensor(sensor)))

    def readImu(self, sensor: Handle) -> tuple[list[float], list[float], list[float]]:
        """Return orientation (x, y, z, w), angular velocity (rad/s), linear acceleration (m/s^2), in sensor axes."""
        reading = read_imu(self._simulation, self._sensor(sensor))
        return reading.orientation.tolist(), reading.angular_velocity.tolist(), reading.linear_acceleration.tolist()

    def readForceSensor(self, sensor: Handle) -> tuple[int, list[float], list[float]]:
        """Return 1, and the force (N) and torque (N m) of a force-torque sensor, averaged over the last step.

        A sensor of createForceSensor measures nothing: 0 and zeros.
        """
        if self._tree.is_created_dummy(self._resolve(sensor)):  # of createForceSensor
            return 0, [0.0, 0.0, 0.0], [0.0, 0.0, 0.0]
        reading = read_force_torque(self._simulation, self._sensor(sensor))
        return 1, reading.force.tolist(), reading.torque.tolist()

    def readNavSat(self, sensor: Handle) -> tuple[list[float], list[float]]:
        """Return [latitude, longitude (degrees), altitude (m above WGS84)], and [east, north, up] velocity (m/s)."""
        reading = read_navsat(self._simulation, self._sensor(sensor))
        return [reading.latitude, reading.longitude, reading.altitude], reading.velocity.tolist()

    def readAltimeter(self, sensor: Handle) -> tuple[float, float]:
        """Return the height (m) above the initial height, and the upward velocity (m/s)."""
        reading = read_altimeter(self._simulation, self._sensor(sensor))
        return reading.height, reading.velocity

    def readMagnetometer(self, sensor: Handle) -> list[float]:
        """Return the magnetic field (T) in the sensor's frame."""
        field: list[float] = read_magnetometer(self._simulation, self._sensor(sensor)).field.tolist()
        return field

    def readContacts(self, sensor: Handle) -> list[dict[str, Any]]:
        """Return the contacts of the sensor's link during the last step, one per pair of shapes.

        Each has ``other``, the handle of the other link, the names ``collision`` and ``otherCollision``, the mean
        ``force`` (N, on the sensor's link) and the lists ``positions`` (m) and ``normals``, all in world axes.
        """
        return [
            {
                "other": contact.other,
                "collision": contact.collision,
                "otherCollision": contact.other_collision,
                "force": contact.force.tolist(),
                "positions": [point.position.tolist() for point in contact.points],
                "normals": [point.normal.tolist() for point in contact.points],
            }
            for contact in read_contacts(self._simulation, self._sensor(sensor)).contacts
        ]

    def _detected(self, reading: Reading, sensor: int) -> Reading:
        limits = self._caller.shared.collections.detected
        return self._limited(reading, limits.get(sensor, self.handle_all) if limits else self.handle_all)

    def _limited(self, reading: Reading, entity: int) -> Reading:
        """Return a reading without an object that does not belong to an object or collection."""
        result, distance, point, found, normal = reading
        if found >= 0 and self._edits.shapes:  # of a created shape, its link
            model = int(self._world.outermost_model_of(found))
            found = self._shown(model) if model in self._edits.shapes else found
        if found < 0 or entity == self.handle_all or self._belongs(found, entity):
            return result, distance, point, found, normal
        return _NOTHING
