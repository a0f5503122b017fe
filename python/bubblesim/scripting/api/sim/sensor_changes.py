# SPDX-License-Identifier: BSD-3-Clause
"""Common parts of the functions that create sensors, and build them anew with other properties."""

from __future__ import annotations

from bubblesim._core import WrongObject, camera_optics
from bubblesim.scene_state.created_sensors import CreatedSensor
from bubblesim.scripting.api.sim.object_changes import ObjectChangeFunctions


class SensorChangeFunctions(ObjectChangeFunctions):
    """Sensors that scripts create are static models with one sensor each."""

    def _add_sensor(self, sensor: CreatedSensor) -> int:
        model = self._add_model(sensor.sdf(), sensor.name)
        made = self._tree.object_of(model)
        self._edits.sensors[made] = int(self._world.parts(model, "sensor")[0])
        self._edits.created_sensors[made] = sensor
        return made

    def _set_pixels(self, camera: int, *, columns: int | None = None, rows: int | None = None) -> None:
        """Set the resolution of a created camera, which is built anew; callers keep its handle."""
        before = camera_optics(self._simulation, self._sensor(camera))[:2]
        wanted = before[0] if columns is None else columns, before[1] if rows is None else rows
        if wanted == tuple(before):
            return
        created = self._edits.created_sensors.get(camera)
        if created is None or created.with_pixels is None:
            raise WrongObject(f"{self._tree.short_path(camera)} has the resolution of its file")
        anew = created.with_pixels(*wanted)  # raises
        known, name, parent = self._shown(camera), self._tree.name(camera), self._tree.parent(camera)
        pose = self._tree.pose(camera)
        self._remove_model(self._tree.model(camera))
        made = self._add_sensor(anew)
        self._edits.replaced[known] = made
        if self._tree.name(made) != name:
            self._tree.set_name(made, name)
        self._tree.set_pose(made, pose)
        if parent >= 0:
            self._tree.set_parent(made, parent, in_place=True)
