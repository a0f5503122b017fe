# SPDX-License-Identifier: BSD-3-Clause
"""`sim` functions for octrees."""

from __future__ import annotations

import math
from typing import Any

from bubblesim.scripting.api.differences import differs
from bubblesim.scripting.api.kinds import Handle, Numbers
from bubblesim.scripting.api.sim.created_meshes import CreatedMeshFunctions

_MOST = 100_000  # voxels


class OctreeFunctions(CreatedMeshFunctions):
    """An octree is a dummy with a set of voxels, cubes of one size in its frame. It has no effect on sensors and
    collisions."""

    @differs("sensors and collisions take it into account; here they do not")
    def createOctree(self, size: float, options: int = 0, point_size: float = 1.0, reserved: Any = None) -> int:
        """Create an octree without voxels at the origin and return its handle; ``size`` of a voxel in m."""
        if not size > 0:
            raise ValueError(f"the size of a voxel must be positive, found {size:g}")
        made = self.createDummy(size)
        self.setObjectAlias(made, "Octree")
        self._octrees[made] = (size, set())
        return made

    def insertVoxelsIntoOctree(
        self, octree: Handle, options: int, points: Numbers, colours: Any = None, tags: Any = None, more: Any = None
    ) -> int:
        """Add the voxels at points, x, y, z each in m, in the world, or with ``options`` 1 in the octree's frame;
        return the number of voxels."""
        _, voxels = self._octree(octree)
        voxels.update(self._voxels_at(octree, options, points))
        if len(voxels) > _MOST:
            raise ValueError(f"an octree has at most {_MOST} voxels")
        return len(voxels)

    def removeVoxelsFromOctree(self, octree: Handle, options: int, points: Any = None, reserved: Any = None) -> int:
        """Remove the voxels at points, or with None (nil) all; return the number of voxels."""
        _, voxels = self._octree(octree)
        voxels.difference_update(self._voxels_at(octree, options, points) if points else set(voxels))
        return len(voxels)

    def getOctreeVoxels(self, octree: Handle) -> list[float]:
        """Return the centres of all voxels, x, y, z each in m, in the octree's frame."""
        size, voxels = self._octree(octree)
        return [(index + 0.5) * size for voxel in sorted(voxels) for index in voxel]

    def checkOctreePointOccupancy(self, octree: Handle, options: int, points: Numbers) -> tuple[int, int, int, int]:
        """Return 1 if all points are in voxels, else 0; and a tag and place, which are 0."""
        _, voxels = self._octree(octree)
        return int(bool(points) and self._voxels_at(octree, options, points) <= voxels), 0, 0, 0

    def insertObjectIntoOctree(self, octree: Handle, handle: Handle, *more: Any) -> int:
        """Add the voxels of the box around an object; return the number of voxels."""
        size, _ = self._octree(octree)
        sizes, place = self.getShapeMesh(handle)[0], self._tree.pose(self._resolve(handle))
        spans = [(min(sizes[axis::3]), max(sizes[axis::3])) for axis in range(3)]
        counts = [max(1, math.ceil((high - low) / size)) for low, high in spans]
        if math.prod(counts) > _MOST:
            raise ValueError(f"the object would have {math.prod(counts)} voxels: at most {_MOST}")
        inside = [
            low + (high - low) * (index + 0.5) / count
            for x in range(counts[0])
            for y in range(counts[1])
            for z in range(counts[2])
            for (low, high), index, count in zip(spans, (x, y, z), counts, strict=True)
        ]
        sim: Any = self
        return self.insertVoxelsIntoOctree(octree, 0, sim.multiplyVector(place, inside))

    def subtractObjectFromOctree(self, octree: Handle, handle: int, *more: Any) -> int:
        """Return the number of voxels, which stay."""
        return len(self._octree(octree)[1])

    def _octree(self, handle: int) -> tuple[float, set[tuple[int, int, int]]]:
        resolved = self._resolve(handle)
        if resolved not in self._octrees:
            raise LookupError(f"{handle} is not the handle of an octree that this script has created")
        size, voxels = self._octrees[resolved]
        return float(size), voxels

    def _voxels_at(self, octree: int, options: int, points: Any) -> set[tuple[int, int, int]]:
        size, _ = self._octree(octree)
        sim: Any = self
        inverse = sim.getPoseInverse(self._tree.pose(self._resolve(octree)))
        given = [float(number) for number in points]
        local = given if options & 1 else sim.multiplyVector(inverse, given)
        return {
            (math.floor(local[i] / size), math.floor(local[i + 1] / size), math.floor(local[i + 2] / size))
            for i in range(0, len(local) - 2, 3)
        }
