# SPDX-License-Identifier: BSD-3-Clause
"""A map of the plane as a grid of cells, like nav_msgs/OccupancyGrid."""

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Any

import cv2
import numpy as np
import numpy.typing as npt

from bubblesim.navigation.planar import Point, heading_of

OCCUPIED = 65  # per cent, minimum of an occupied cell, as in map_server
FREE = 25  # per cent, maximum of a free cell
UNKNOWN = -1

Cell = tuple[int, int]
"""Row and column; row 0 is at the map's origin."""


@dataclass(frozen=True)
class GridMap:
    """Cells hold the occupancy in per cent, -1 if unknown. Lengths in m, angles in rad."""

    cells: npt.NDArray[np.int8]  # rows x columns
    resolution: float  # of a cell
    origin: tuple[float, float, float] = (0.0, 0.0, 0.0)  # the lower left corner: x, y, heading

    @classmethod
    def from_message(cls, message: Any) -> "GridMap":
        """Convert a nav_msgs/OccupancyGrid."""
        info = message.info
        cells = np.asarray(message.data, dtype=np.int8)
        origin = (info.origin.position.x, info.origin.position.y, heading_of(info.origin.orientation))
        return cls(cells.reshape(info.height, info.width), info.resolution, origin)

    @property
    def occupied(self) -> npt.NDArray[np.bool_]:
        """Return a mask of the occupied cells."""
        return self.cells >= OCCUPIED

    @property
    def free(self) -> npt.NDArray[np.bool_]:
        """Return a mask of the free cells."""
        return (self.cells >= 0) & (self.cells <= FREE)

    def cell_of(self, point: Point) -> Cell:
        """Return the cell of a point, which may be outside of the map."""
        x, y, heading = self.origin
        dx, dy = point[0] - x, point[1] - y
        cosine, sine = math.cos(heading), math.sin(heading)
        column = (cosine * dx + sine * dy) / self.resolution
        row = (cosine * dy - sine * dx) / self.resolution
        return math.floor(row), math.floor(column)

    def centre_of(self, cell: Cell) -> Point:
        """Return the centre of a cell."""
        x, y, heading = self.origin
        along, up = (cell[1] + 0.5) * self.resolution, (cell[0] + 0.5) * self.resolution
        cosine, sine = math.cos(heading), math.sin(heading)
        return x + cosine * along - sine * up, y + sine * along + cosine * up

    def has(self, cell: Cell) -> bool:
        """Return whether a cell is on the map."""
        rows, columns = self.cells.shape
        return 0 <= cell[0] < rows and 0 <= cell[1] < columns

    def clearance(self) -> npt.NDArray[np.float32]:
        """Return for each cell the distance to the nearest occupied cell."""
        if not self.occupied.any():
            return np.full(self.cells.shape, np.inf, dtype=np.float32)
        open_space = np.where(self.occupied, 0, 255).astype(np.uint8)
        distances: npt.NDArray[np.float32] = cv2.distanceTransform(open_space, cv2.DIST_L2, 5)
        return distances * np.float32(self.resolution)

    def around(self, points: Sequence[Point], margin: float) -> "GridMap":
        """Return the part of the map that has all cells nearer to the points than a margin, m."""
        cells = np.array([self.cell_of(point) for point in points])
        reach = math.ceil(margin / self.resolution) + 1
        top, left = np.clip(cells.min(axis=0) - reach, 0, None).tolist()
        bottom, right = np.clip(cells.max(axis=0) + reach + 1, 0, None).tolist()
        x, y, heading = self.origin
        along, up = left * self.resolution, top * self.resolution
        cosine, sine = math.cos(heading), math.sin(heading)
        origin = x + cosine * along - sine * up, y + sine * along + cosine * up, heading
        return replace(self, cells=self.cells[top:bottom, left:right], origin=origin)

    def with_obstacles(self, points: list[Point]) -> "GridMap":
        """Return a copy with occupied cells at the points."""
        cells = self.cells.copy()
        for cell in map(self.cell_of, points):
            if self.has(cell):
                cells[cell] = 100
        return replace(self, cells=cells)
