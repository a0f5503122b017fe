# SPDX-License-Identifier: BSD-3-Clause
"""`sim` functions for distances, collisions and the sizes of shapes."""

from __future__ import annotations

import math

from bubblesim.scene_state.compound_shapes import CompoundShape
from bubblesim.scene_state.primitive_shapes import PrimitiveShape
from bubblesim.scripting.api.differences import differs
from bubblesim.scripting.api.kinds import Handle
from bubblesim.scripting.api.sim.logs import LogFunctions
from bubblesim.scripting.api.sim.object_changes import ObjectChangeFunctions
from bubblesim.scripting.api.sim.object_collections import CollectionFunctions

_NOT_READ = "objects of scenes before 4.2 are handled; here they are not read: use checkCollision and checkDistance"

_NO_LIMIT = 1e9  # m


class DistanceFunctions(ObjectChangeFunctions, CollectionFunctions, LogFunctions):
    """Entities are shapes, models (with all their links), collections and sim.handle_all, which is all but the other
    entity. They are the shapes that collide, as physics sees them; shapes without the special property collidable or
    measurable are left out."""

    def checkCollision(self, first: int, second: int) -> tuple[int, list[int]]:
        """Return 1 if two entities touch or overlap, else 0, and the handles of two objects that do."""
        found = self._nearest(first, second, 0.0, self.objectspecialproperty_collidable)
        if found is None:
            return 0, []
        return 1, [self._shape_of(found[3]), self._shape_of(found[4])]

    @differs("it returns the segments in which surfaces intersect; here one pair of points")
    def checkCollisionEx(self, first: int, second: int) -> tuple[int, list[float]]:
        """Return 1 if two entities touch or overlap, else 0, and their nearest points, 6 numbers.

        If they overlap, it is twice a point of one of them."""
        found = self._nearest(first, second, 0.0, self.objectspecialproperty_collidable)
        return (0, []) if found is None else (1, [*found[1], *found[2]])

    def checkDistance(self, first: int, second: int, threshold: float = 0.0) -> tuple[int, list[float], list[int]]:
        """Return 1 if two entities are nearer to each other than ``threshold`` (m; 0: any), else 0; the numbers x, y, z
        of the nearest point of the first one, of that of the second one, and their distance; and the two objects.

        Positions are in the world. The distance is 0 where entities touch or overlap.
        """
        limit = threshold if threshold > 0 else _NO_LIMIT
        found = self._nearest(first, second, limit, self.objectspecialproperty_measurable)
        if found is None:
            return 0, [], []
        distance, on_first, on_second, link, other = found
        return 1, [*on_first, *on_second, distance], [self._shape_of(link), self._shape_of(other)]

    @differs(_NOT_READ)
    def getCollisionHandle(self, name: str) -> int:
        """Accept the name of a collision object of old scenes, with a warning: use checkCollision. Return 0."""
        self._use("getCollisionHandle", f"the collision object '{name}' is not read: use sim.checkCollision")
        return 0

    @differs(_NOT_READ)
    def getDistanceHandle(self, name: str) -> int:
        """Accept the name of a distance object of old scenes, with a warning: use checkDistance. Return 0."""
        self._use("getDistanceHandle", f"the distance object '{name}' is not read: use sim.checkDistance")
        return 0

    @differs(_NOT_READ)
    def handleCollision(self, collision: int = -2) -> int:
        """Return 0: there are no collision objects (main scripts)."""
        return 0

    @differs(_NOT_READ)
    def readCollision(self, collision: int) -> int:
        """Return 0: there are no collision objects."""
        return 0

    @differs(_NOT_READ)
    def handleDistance(self, distance: int = -2) -> tuple[int, float]:
        """Return 0 and 0.0: there are no distance objects (main scripts)."""
        return 0, 0.0

    @differs(_NOT_READ)
    def readDistance(self, distance: int) -> tuple[int, float]:
        """Return 0 and 0.0: there are no distance objects."""
        return 0, 0.0

    def getCollectionHandle(self, name: str) -> int:
        """Return the handle of a collection of the scene's file, or of a collection that setCollectionName has named;
        an empty collection is created if none has the name (old name of createCollection)."""
        made = self._caller.shared.collections.by_name
        if name not in made or made[name] not in self._caller.shared.collections.by_handle:
            made[name] = self._saved_collection(name)
        return made[name]

    def getShapeBB(self, shape: Handle) -> list[float]:
        """Return the size, x, y, z in m, of the smallest box along a shape's own axes with all its collision shapes."""
        low, high = self._bounds(self._resolve(shape))
        return [b - a for a, b in zip(low, high, strict=True)]

    def getShapeGeomInfo(self, shape: Handle) -> tuple[int, int, list[float]]:
        """Return flags (1 compound, 2 plain), the kind, sim.primitiveshape_cuboid for example, and x, y, z and the
        inner size of a shape that was created; of others 0, sim.primitiveshape_none and the sizes of the box around
        it."""
        handle = self._resolve(shape)
        made = self._edits.shapes.get(self._tree.model(handle))
        if isinstance(made, PrimitiveShape):
            return 2, made.kind, [*made.sizes, 0.0]
        return int(isinstance(made, CompoundShape)), self.primitiveshape_none, [*self.getShapeBB(shape), 0.0]

    def getShapeMassAndInertia(self, shape: Handle, matrix: object = None) -> tuple[float, list[float], list[float]]:
        """Return mass (kg), inertia (kg m^2, a 3x3 matrix about the centre of mass, in the shape's axes) and the
        centre of mass in the shape's frame (old style). The inertia of a model, or of a shape that is no body, is that
        of a box of its size with even density."""
        handle = self._resolve(shape)
        mass = self.getShapeMass(shape)
        links = self._links(handle)
        if links == [handle] and not self._world.is_static(self._tree.model(handle)):
            of_file, middle = self._world.inertia(handle)
            return mass, list(of_file), list(middle)
        low, high = self._bounds(handle)
        x, y, z = (b - a for a, b in zip(low, high, strict=True))
        moments = [mass / 12 * (y * y + z * z), mass / 12 * (x * x + z * z), mass / 12 * (x * x + y * y)]
        inertia = [moments[i] if i == j else 0.0 for i in range(3) for j in range(3)]
        return mass, inertia, [(a + b) / 2 for a, b in zip(low, high, strict=True)]

    def getShapeInertia(self, shape: Handle) -> tuple[list[float], list[float]]:
        """Return inertia (see getShapeMassAndInertia) and a matrix with the centre of mass."""
        _, inertia, centre = self.getShapeMassAndInertia(shape)
        x, y, z = centre
        return inertia, [1.0, 0.0, 0.0, x, 0.0, 1.0, 0.0, y, 0.0, 0.0, 1.0, z]

    def computeMassAndInertia(self, shape: Handle, density: float) -> int:
        """Set the mass of a shape by its density, kg/m^3, and the volume of the box around it; return 1."""
        if not density > 0 or not math.isfinite(density):
            raise ValueError(f"the density of a shape must be positive, found {density:g}")
        self.setShapeMass(shape, density * math.prod(self.getShapeBB(shape)))
        return 1

    def _use(self, function: str, why: str) -> None:
        self.addLog(self.verbosity_scriptwarnings | self.verbosity_once, f"sim.{function}: {why}")

    def _bounds(self, handle: int) -> tuple[list[float], list[float]]:
        found = self._box_of(self._links(handle), handle)
        if found is None:
            raise ValueError(f"{self._tree.short_path(handle)} has no shape of a finite size that collides")
        return found

    def _shape_of(self, link: int) -> int:
        """Return the object that scripts know for a link: its model, if it has one link."""
        model = self._tree.model(link)
        whole = len(self._world.parts(model, "link")) == 1 and not self._world.is_hidden(model)
        return self._shown(model if whole else link)

    def _links(self, handle: int) -> list[int]:
        """Return the links of an object: of a model all."""
        kind = self._tree.kind(handle)
        if kind == "model":
            return [int(link) for link in self._world.parts(handle, "link")]
        if kind == "link":
            return [handle]
        if kind == "shape":
            carrier = int(self._world.frame_link(handle))
            return [carrier] if carrier >= 0 else []
        return []

    def _objects_of_entity(self, entity: int) -> list[int]:
        if entity == self.handle_all:
            return [each for root in self._tree.children(-1) for each in self._tree.with_all_below(root)]
        if entity in self._caller.shared.collections.by_handle:
            return self.getCollectionObjects(entity)
        found = self._resolve(entity)
        self._tree.kind(found)  # raises
        return [found]

    def _links_of_entity(self, entity: int, property_bit: int) -> set[int]:
        """Return the links of an entity that have a special property."""
        objects = self._objects_of_entity(entity)
        settings = self._caller.shared.settings

        def has_property(handle: int) -> bool:
            """Return whether an object has it; parts of a model have not what the model has not."""
            chain = (handle, self._tree.model(handle))
            return all(settings.get((int, f"special property {e}"), property_bit) & property_bit for e in chain)

        kept = [handle for handle in objects if has_property(handle)]
        return {link for each in kept for link in self._links(each)}

    def _nearest(
        self, first: int, second: int, limit: float, property_bit: int
    ) -> tuple[float, list[float], list[float], int, int] | None:
        of_first = self._links_of_entity(first, property_bit)
        of_second = self._links_of_entity(second, property_bit)
        if second == self.handle_all:
            of_second -= of_first
        elif first == self.handle_all:
            of_first -= of_second
        found: tuple[float, list[float], list[float], int, int] | None = self._world.nearest(
            sorted(of_first), sorted(of_second), limit
        )
        return found
