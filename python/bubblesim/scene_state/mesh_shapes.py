# SPDX-License-Identifier: BSD-3-Clause
"""The models of triangle meshes that scripts and programs create."""

from __future__ import annotations

import tempfile
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt

from bubblesim.scene_state.created_shapes import Part, model_sdf

Array = npt.NDArray[np.float64]
_DENSITY = 1000.0  # kg/m^3
_NONE = 0  # sim.primitiveshape_none
_MOST_TRIANGLES = 1_000_000
_LEAST_MASS = 1e-6  # kg
_files: list[tempfile.TemporaryDirectory[str]] = []


@dataclass
class MeshShape:
    """A model of one link with one mesh about the centre of its box."""

    vertices: Array
    """n x 3, m."""
    triangles: npt.NDArray[np.int64]
    """m x 3, indices of vertices from 0."""
    mass: float = 0.0
    """kg; 0: that of water of this volume."""
    static: bool = True
    respondable: bool = False
    name: str = "Shape"
    file: Path | None = None
    """Where the mesh is written."""

    def __post_init__(self) -> None:
        """Check the mesh."""
        if not 0 < len(self.triangles) <= _MOST_TRIANGLES:
            raise ValueError(f"a mesh has 1 to {_MOST_TRIANGLES} triangles, found {len(self.triangles)}")
        if not np.isfinite(self.vertices).all():
            raise ValueError("the vertices of a mesh must be finite")
        if self.triangles.min() < 0 or self.triangles.max() >= len(self.vertices):
            raise ValueError(
                f"the indices of a mesh of {len(self.vertices)} vertices are 0 to {len(self.vertices) - 1}"
            )
        if not self.mass:
            self.mass = max(_DENSITY * abs(self._moments()[0]), _LEAST_MASS)

    @property
    def kind(self) -> int:
        """Return sim.primitiveshape_none."""
        return _NONE

    @property
    def sizes(self) -> list[float]:
        """Return the sizes of the box around it, m."""
        return [float(size) for size in np.ptp(self.vertices, axis=0)]

    def sdf(self) -> str:
        """Return the model as SDFormat."""
        return model_sdf(self, [self.part()])

    def part(self) -> Part:
        """Return what a link has of it."""
        volume, centre, inertia = self._moments()
        if abs(volume) < 1e-12:  # it is open: that of its box
            x, y, z = (max(size, 1e-3) ** 2 for size in self.sizes)
            centre, matrix = np.zeros(3), np.diag([y + z, x + z, x + y]) / 12
        else:
            matrix = inertia / volume
        geometry = f"<mesh><uri>file://{self._written()}</uri></mesh>"
        return Part(geometry, self.mass, matrix * self.mass, centre)

    def _moments(self) -> tuple[float, Array, Array]:
        """Return volume, centre, and inertia of a density of 1 about the centre, by tetrahedra with the origin."""
        corners = self.vertices[self.triangles]
        six = np.linalg.det(corners)
        volume = float(six.sum() / 6)
        if abs(volume) < 1e-12:
            return 0.0, np.zeros(3), np.eye(3)
        total = corners.sum(axis=1)
        centre: Array = (six[:, None] * total).sum(axis=0) / 24 / volume
        second = np.einsum("n,ni,nj->ij", six, total, total) + np.einsum("n,nki,nkj->ij", six, corners, corners)
        about_centre = second / 120 - volume * np.outer(centre, centre)
        return volume, centre, np.trace(about_centre) * np.eye(3) - about_centre

    def _written(self) -> Path:
        """Return the file of the mesh, in binary STL, which lasts as long as the process."""
        if self.file is None:
            if not _files:
                _files.append(tempfile.TemporaryDirectory(prefix="bubblesim_meshes_"))
            self.file = Path(_files[0].name) / f"mesh_{len(list(Path(_files[0].name).iterdir()))}.stl"
            record = np.dtype([("normal", "<f4", 3), ("corners", "<f4", (3, 3)), ("more", "<u2")])
            written: Any = np.zeros(len(self.triangles), record)
            written["corners"] = self.vertices[self.triangles]
            self.file.write_bytes(b"\0" * 80 + np.uint32(len(written)).tobytes() + written.tobytes())
        return self.file


def centred(vertices: Array, triangles: npt.NDArray[np.int64]) -> tuple[MeshShape, list[float]]:
    """Return the shape of a mesh, and the centre of its box, which is the shape's origin."""
    used = vertices[np.unique(triangles)] if len(triangles) and triangles.max(initial=0) < len(vertices) else vertices
    centre = (used.min(axis=0) + used.max(axis=0)) / 2 if len(used) else np.zeros(3)
    return MeshShape(vertices - centre, triangles), [float(part) for part in centre]
