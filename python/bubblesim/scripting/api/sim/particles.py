# SPDX-License-Identifier: BSD-3-Clause
"""`sim` functions for particles and point clouds."""

from __future__ import annotations

import math
from dataclasses import dataclass, field
from typing import Any

from bubblesim.scripting.api.differences import differs
from bubblesim.scripting.api.kinds import Handle, Numbers
from bubblesim.scripting.api.sim.drawings import DrawingFunctions

_COLOUR = [0.2, 0.5, 1.0]
_MOST = 20_000


@dataclass
class _Particles:
    drawing: int
    lifetime: float
    """s; 0: without end."""
    falls: bool
    most: int
    moving: list[tuple[list[float], list[float], float]] = field(default_factory=list)
    """Position, velocity and the time of the end, s."""


class ParticleFunctions(DrawingFunctions):
    """Particles fly under gravity and are drawn; they collide with nothing. Point clouds are drawn."""

    @differs("particles may collide; here they fly through objects")
    def addParticleObject(
        self,
        kind: int,
        size: float,
        density: float = 1000.0,
        parameters: object = None,
        lifetime: float = 0.0,
        most: int = 1000,
        colour: Any = None,
        specular: object = None,
        auxiliary: object = None,
        emission: object = None,
    ) -> int:
        """Add particles of a diameter in m and return their handle: they end after ``lifetime`` s (0: never), and the
        oldest when there are more than ``most``. ``kind``: sim.particle_spheres and sim.particle_ignoresgravity
        count."""
        shown = list(colour)[:3] if isinstance(colour, list | tuple) and len(colour) >= 3 else _COLOUR
        most = min(max(1, most or _MOST), _MOST)
        drawing = self.addDrawingObject(self.drawing_spherepoints, size, 0.0, -1, most, shown)
        falls = not kind & self.particle_ignoresgravity
        self._particles[drawing] = _Particles(drawing, lifetime, falls, most)
        self._caller.in_each_step["particles"] = self._move_particles
        return drawing

    def addParticleObjectItem(self, particles: int, item: Any = None, time: float = 0.0) -> int:
        """Add a particle: x, y, z of its place and of its velocity (m, m/s; in old scripts of a second point where it
        is after a second); None (nil) removes all. Return 1."""
        found = self._particles_at(particles)
        if item is None:
            found.moving.clear()
            return 1
        numbers = [float(number) for number in item]
        if len(numbers) < 6:
            raise ValueError(f"a particle has 6 numbers, found {len(numbers)}")
        start, end = numbers[:3], numbers[3:6]
        velocity = [b - a for a, b in zip(start, end, strict=True)]
        until = float(self._simulation.time) + found.lifetime if found.lifetime > 0 else float("inf")
        found.moving.append((start, velocity, until))
        del found.moving[: -found.most]
        return 1

    def removeParticleObject(self, particles: int) -> int:
        """Remove particles; return 1. Old scripts have -1 where there are none."""
        if particles == -1:
            return 1
        if particles == self.handle_all:
            for each in list(self._particles):
                self.removeParticleObject(each)
            return 1
        self._particles_at(particles)
        del self._particles[particles]
        self.removeDrawingObject(particles)
        return 1

    @differs("sensors and collisions take it into account; here they do not")
    def createPointCloud(
        self, size: float = 0.02, most: int = 20, options: int = 0, point_size: float = 2.0, reserved: object = None
    ) -> int:
        """Create a point cloud at the origin of the world and return its handle; it is a drawing."""
        drawing = self.addDrawingObject(self.drawing_points, point_size, 0.0, -1, _MOST, _COLOUR)
        self._clouds[drawing] = []
        return drawing

    def insertPointsIntoPointCloud(
        self, cloud: int, options: int, points: Numbers, colours: object = None, tolerance: object = None
    ) -> int:
        """Add points, x, y and z each in m; return the number of points of the cloud."""
        known = self._cloud(cloud)
        added = [points[i : i + 3] for i in range(0, len(points) - 2, 3)]
        known += added[: _MOST - len(known)]
        for point in added:
            self.addDrawingObjectItem(cloud, point)
        return len(known)

    def removePointsFromPointCloud(
        self, cloud: int, options: int = 0, points: Any = None, tolerance: float = 0.0, reserved: object = None
    ) -> int:
        """Remove the points that are nearer than ``tolerance`` to one of ``points``, or with None (nil) all; return the
        number of points of the cloud."""
        known = self._cloud(cloud)
        near = [float(number) for number in points] if points else []
        limit = max(tolerance, 1e-9) ** 2

        def is_removed(point: list[float]) -> bool:
            return not near or any(
                sum((a - b) ** 2 for a, b in zip(point, near[i : i + 3], strict=True)) <= limit
                for i in range(0, len(near) - 2, 3)
            )

        known[:] = [point for point in known if not is_removed(point)]
        self.addDrawingObjectItem(cloud, None)
        for point in known:
            self.addDrawingObjectItem(cloud, point)
        return len(known)

    def getPointCloudPoints(self, cloud: int) -> list[float]:
        """Return x, y and z of all points of a cloud."""
        return [number for point in self._cloud(cloud) for number in point]

    def insertObjectIntoPointCloud(
        self, cloud: int, handle: Handle, options: int = 0, size: float = 0.02, *more: Any
    ) -> int:
        """Add the corners of the box around an object to a cloud; return the number of its points."""
        sim: Any = self
        corners = sim.multiplyVector(self._tree.pose(self._resolve(handle)), sim.getShapeMesh(handle)[0])
        return self.insertPointsIntoPointCloud(cloud, 0, corners)

    def subtractObjectFromPointCloud(
        self, cloud: int, handle: int, options: int = 0, tolerance: float = 0.0, *more: Any
    ) -> int:
        """Return the number of points, which stay."""
        return len(self._cloud(cloud))

    def intersectPointsWithPointCloud(self, cloud: int, options: int, points: Numbers, tolerance: float) -> int:
        """Remove the points that are not near one of ``points``; return the number of points."""
        known, limit = self._cloud(cloud), tolerance * tolerance
        near = [points[i : i + 3] for i in range(0, len(points) - 2, 3)]
        kept = [each for each in known if any(math.dist(each, point) ** 2 <= limit for point in near)]
        self.removePointsFromPointCloud(cloud)
        return self.insertPointsIntoPointCloud(cloud, 0, [number for point in kept for number in point])

    def getPointCloudOptions(self, cloud: int) -> tuple[float, int, int, float]:
        """Return the size of cells, the number of points in one, options and the size of points of a cloud."""
        self._cloud(cloud)
        return 0.02, 20, 0, 2.0

    def setPointCloudOptions(self, cloud: int, *options: Any) -> int:
        """Accept the settings of a cloud; return 1."""
        self._cloud(cloud)
        return 1

    def _particles_at(self, handle: int) -> _Particles:
        if handle not in self._particles:
            raise LookupError(f"no particles have the handle {handle}")
        particles: _Particles = self._particles[handle]
        return particles

    def _cloud(self, handle: int) -> list[list[float]]:
        if handle not in self._clouds:
            raise LookupError(f"no point cloud has the handle {handle}")
        return self._clouds[handle]

    def _move_particles(self) -> None:
        now, step = float(self._simulation.time), float(self._simulation.time_step)
        gravity = [float(number) for number in self._world.gravity]
        for each in self._particles.values():
            moved = []
            for at, velocity, until in each.moving:
                if until <= now:
                    continue
                after = [v + g * step if each.falls else v for v, g in zip(velocity, gravity, strict=True)]
                moved.append(
                    ([x + (v + w) / 2 * step for x, v, w in zip(at, velocity, after, strict=True)], after, until)
                )
            if moved or each.moving:
                self.addDrawingObjectItem(each.drawing, None)
                for at, _, _ in moved:
                    self.addDrawingObjectItem(each.drawing, at)
            each.moving = moved
