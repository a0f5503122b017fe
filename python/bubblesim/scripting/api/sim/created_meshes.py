# SPDX-License-Identifier: BSD-3-Clause
"""`sim` functions that create shapes of triangles, group shapes and scale them."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np

from bubblesim.geometry import poses
from bubblesim.scene_state.compound_shapes import CompoundShape, members_of
from bubblesim.scene_state.mesh_files import read_mesh
from bubblesim.scene_state.mesh_shapes import MeshShape, centred
from bubblesim.scripting.api.differences import differs
from bubblesim.scripting.api.kinds import Handle, Integers, Numbers, Vector3
from bubblesim.scripting.api.sim.created_objects import CreatedObjectFunctions

_FRAME_STAYS = "it changes the frame of a shape and the box around it; here they stay"

_MOST_POINTS = 1_000_000  # of a height field


class CreatedMeshFunctions(CreatedObjectFunctions):
    """Such shapes are static and not respondable at first, as those of createPrimitiveShape. Their origin is the centre
    of the box around them. Not in sysCall_sensing."""

    def createShape(
        self,
        options: int,
        shading_angle: float,
        vertices: Numbers,
        indices: Integers,
        normals: Any = None,
        coordinates: Any = None,
        texture: Any = None,
        resolution: Any = None,
    ) -> int:
        """Create a shape of triangles and return its handle: ``vertices`` are x, y, z each in m, ``indices`` three
        vertices each, from 0. The others, for drawings, have no effect."""
        points = np.array(vertices[: len(vertices) // 3 * 3], float).reshape(-1, 3)
        corners = np.array(indices[: len(indices) // 3 * 3], np.int64).reshape(-1, 3)
        return self._add_mesh(*centred(points, corners))

    def createHeightfieldShape(
        self, options: int, shading_angle: float, columns: int, rows: int, size: float, heights: Numbers
    ) -> int:
        """Create a surface of ``columns`` x ``rows`` points and return its handle; ``size`` is its length along x in m,
        ``heights`` are those of the points in m, row by row."""
        if columns < 2 or rows < 2 or columns * rows > _MOST_POINTS or len(heights) != columns * rows:
            raise ValueError(
                f"a surface of {columns} x {rows} points has at least 2 x 2, at most {_MOST_POINTS}, with a height "
                f"each, found {len(heights)}"
            )
        step = size / (columns - 1)
        y, x = np.divmod(np.arange(columns * rows), columns)
        points = np.column_stack([(x - (columns - 1) / 2) * step, (y - (rows - 1) / 2) * step, np.array(heights)])
        first = (np.arange(rows - 1)[:, None] * columns + np.arange(columns - 1)).ravel()
        right, up, across = first + 1, first + columns, first + columns + 1
        corners = np.concatenate([np.column_stack([first, right, across]), np.column_stack([first, across, up])])
        return self._add_mesh(*centred(points, corners))

    def importShape(
        self, file_format: int, file: str, options: int = 0, tolerance: float = 0.0, scaling: float = 1.0
    ) -> int:
        """Create a shape from a mesh file, .obj or .stl, and return its handle. For callers that may use files."""
        if not self._caller.may_use_files:
            raise PermissionError("sim.importShape reads files: a Python script may, and clients of --remote-trusted")
        vertices, triangles = read_mesh(Path(file))
        return self._add_mesh(*centred(vertices * (scaling or 1.0), triangles))

    def importMesh(
        self, file_format: int, file: str, options: int = 0, tolerance: float = 0.0, scaling: float = 1.0
    ) -> tuple[list[list[float]], list[list[int]]]:
        """Return the vertices and the indices of a mesh file, .obj or .stl, as lists of one list. For callers that may
        use files."""
        if not self._caller.may_use_files:
            raise PermissionError("sim.importMesh reads files: a Python script may, and clients of --remote-trusted")
        vertices, triangles = read_mesh(Path(file))
        return [(vertices * (scaling or 1.0)).ravel().tolist()], [triangles.ravel().tolist()]

    def getShapeMesh(self, shape: Handle) -> tuple[list[float], list[int], list[float]]:
        """Return vertices, indices and normals (3 corners of each triangle) of a shape of createShape; of others those
        of the box around it."""
        handle = self._resolve(shape)
        made = self._edits.shapes.get(self._tree.model(handle))
        if isinstance(made, MeshShape):
            vertices, triangles = made.vertices, made.triangles
        else:
            sim: Any = self
            vertices, triangles = _box(sim.getShapeBB(shape))
        corners = vertices[triangles]
        normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
        normals /= np.maximum(np.linalg.norm(normals, axis=1, keepdims=True), 1e-12)
        return vertices.ravel().tolist(), triangles.ravel().tolist(), np.repeat(normals, 3, axis=0).ravel().tolist()

    def getShapeViz(self, shape: Handle, item: int) -> dict[str, Any] | None:
        """Return ``vertices``, ``indices``, ``normals`` and ``colors`` of a shape (see getShapeMesh); None (nil) for an
        ``item`` above 0."""
        if item > 0:
            return None
        vertices, indices, normals = self.getShapeMesh(shape)
        colour = self._colour(self._resolve(shape), self.colorcomponent_ambient_diffuse) or [0.0, 0.0, 0.0]
        return {
            "vertices": vertices,
            "indices": indices,
            "normals": normals,
            "colors": [*colour, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0],
            "shadingAngle": 0.5,
            "options": 0,
        }

    @differs("it makes one shape of any shapes; here of those that scripts created, and attaches those of the file")
    def groupShapes(self, handles: Integers, merge: bool = False) -> int:
        """Make one body of shapes that scripts have created, and return its handle. It is static and respondable as the
        first one. Of shapes of the file, the others are attached to the first one, with a warning."""
        resolved = [self._resolve(handle) for handle in handles]
        if not resolved:
            raise ValueError("sim.groupShapes: no shapes are given")
        models = [self._tree.model(handle) for handle in resolved]
        shapes = [self._edits.shapes.get(model) for model in models]
        if any(shape is None for shape in shapes):
            level = self.verbosity_scriptwarnings | self.verbosity_once
            self.addLog(level, "sim.groupShapes: shapes of the file are not made one: they are attached to the first")
            for other in resolved[1:]:
                self.setObjectParent(other, resolved[0], True)
            return self._shown(resolved[0])
        if len(resolved) == 1:
            return self._shown(resolved[0])
        places = [self._tree.pose(model) for model in models]
        middle = np.mean([pose[:3] for pose in places], axis=0)
        centre = [*(float(part) for part in middle), 0.0, 0.0, 0.0, 1.0]
        back = poses.inverse(centre)
        members = []
        for model, shape, pose in zip(models, shapes, places, strict=True):
            assert shape is not None
            members += members_of(shape, poses.multiply(back, pose), self._simulation.color(model))
        first, parent, name = shapes[0], self._tree.parent(models[0]), self._tree.name(models[0])
        assert first is not None
        compound = CompoundShape(members, first.static, first.respondable)
        self.removeObjects([self._shown(model) for model in models])
        made = self._add_shape(compound)
        self._tree.set_pose(made, centre)
        self._tree.set_name(made, name)
        if parent >= 0 and self._tree.contains(parent):
            self._tree.set_parent(made, parent, in_place=True)
        self._update_hold(made)
        return made

    def ungroupShape(self, handle: Handle) -> list[int]:
        """Make the shapes of a group bodies again, and return their handles; of other shapes their own one."""
        group = self._resolve(handle)
        compound = self._edits.shapes.get(self._tree.model(group))
        if not isinstance(compound, CompoundShape):
            return [self._shown(group)]
        place = self._tree.pose(group)
        self.removeObjects([handle])
        found = []
        for member in compound.members:
            member.shape.static, member.shape.respondable = compound.static, compound.respondable
            made = self._add_shape(member.shape)
            self._tree.set_pose(made, poses.multiply(place, member.pose))
            self._update_hold(made)
            self.setShapeColor(made, None, self.colorcomponent_ambient_diffuse, member.colour)
            found.append(made)
        return found

    @differs("it scales all objects; here dummies and created shapes, others keep their size, with a warning")
    def scaleObjects(self, handles: Integers, factor: float, positions: bool = True) -> int:
        """Scale dummies and created shapes, with their masses; with ``positions`` also their distances from the first
        one. Shapes of the file keep their size, with a warning. Return 1."""
        centre = self._tree.pose(self._resolve(handles[0]))[:3] if handles else [0.0, 0.0, 0.0]
        for handle in handles:
            self.scaleObject(handle, factor, factor, factor)
            pose = self._tree.pose(self._resolve(handle))
            moved = [c + factor * (p - c) for c, p in zip(centre, pose[:3], strict=True)]
            if positions and moved != pose[:3]:
                self._tree.set_pose(self._resolve(handle), [*moved, *pose[3:]])
        return 1

    def scaleObject(self, handle: Handle, x: float, y: float, z: float, options: int = 0) -> int:
        """Scale a dummy or a created shape along its axes, with its mass; return 1."""
        if not min(x, y, z) > 0:
            raise ValueError(f"the factors must be positive, found {[x, y, z]}")
        resolved = self._resolve(handle)
        if not self._tree.has_body(resolved):
            self._tree.dummy(resolved).size *= x
            return 1
        made = self._edits.shapes.get(self._tree.model(resolved))
        if made is None:
            path = self._tree.short_path(resolved)
            level = self.verbosity_scriptwarnings | self.verbosity_once
            self.addLog(level, f"{path} keeps its size: only shapes that scripts have created can be scaled")
            return 1
        for each in made.members if isinstance(made, CompoundShape) else ():
            each.pose = [each.pose[0] * x, each.pose[1] * y, each.pose[2] * z, *each.pose[3:]]
            _scale(each.shape, [x, y, z])
        if not isinstance(made, CompoundShape):
            _scale(made, [x, y, z])
        else:
            made.mass *= x * y * z
        self._rebuild(self._tree.model(resolved))
        return 1

    def setShapeBB(self, shape: Handle, size: Vector3) -> int:
        """Scale a created shape to the size of the box around it, x, y, z in m; return 1."""
        sim: Any = self
        now = sim.getShapeBB(shape)
        return self.scaleObject(shape, *(max(new, 1e-6) / max(old, 1e-6) for new, old in zip(size, now, strict=True)))

    @differs(_FRAME_STAYS)
    def relocateShapeFrame(self, shape: Handle, pose: Any = None) -> int:
        """Return 0: the frame of a shape stays where it is."""
        self._tree.kind(self._resolve(shape))  # raises
        return 0

    @differs(_FRAME_STAYS)
    def alignShapeBB(self, shape: Handle, pose: Any = None) -> int:
        """Return 0: the box around a shape stays along the axes of its frame."""
        self._tree.kind(self._resolve(shape))  # raises
        return 0

    @differs(_FRAME_STAYS)
    def reorientShapeBoundingBox(self, shape: Handle, relative_to: int = -1, reserved: Any = None) -> int:
        """Return 0: the box around a shape stays along the axes of its frame (old name)."""
        self._tree.kind(self._resolve(shape))  # raises
        return 0

    @differs("it sets any inertia; here a shape has that of its form and mass, with a warning")
    def setShapeInertia(self, shape: Handle, inertia: Numbers, transformation: Any = None) -> None:
        """Accept an inertia; a shape has that of its form and mass, with a warning."""
        level = self.verbosity_scriptwarnings | self.verbosity_once
        path = self._tree.short_path(self._resolve(shape))
        self.addLog(level, f"sim.setShapeInertia: {path} keeps the inertia of its form and mass")

    def setShapeMassAndInertia(
        self, shape: Handle, mass: float, inertia: Numbers, centre: Any = None, transformation: Any = None
    ) -> int:
        """Set the mass of a shape, kg; the inertia is that of its form (old style). Return 1."""
        self.setShapeMass(shape, mass)
        return 1

    def _add_mesh(self, shape: MeshShape, centre: list[float]) -> int:
        made = self._add_shape(shape)
        self._tree.set_pose(made, [*centre, 0.0, 0.0, 0.0, 1.0])
        self._update_hold(made)
        return made


def _scale(shape: Any, factors: list[float]) -> None:
    """Scale a shape that is not a group."""
    if isinstance(shape, MeshShape):
        shape.vertices, shape.file = shape.vertices * np.array(factors), None
    else:
        shape.sizes = [size * factor for size, factor in zip(shape.sizes, factors, strict=True)]
    shape.mass *= float(np.prod(factors))


def _box(sizes: list[float]) -> tuple[Any, Any]:
    """Return the vertices and triangles of a box about the origin."""
    signs = np.array([[i & 1, i >> 1 & 1, i >> 2 & 1] for i in range(8)]) - 0.5
    faces = [(0, 2, 3, 1), (4, 5, 7, 6), (0, 1, 5, 4), (2, 6, 7, 3), (0, 4, 6, 2), (1, 3, 7, 5)]
    return signs * np.array(sizes), np.array([t for a, b, c, d in faces for t in ((a, b, c), (a, c, d))])
