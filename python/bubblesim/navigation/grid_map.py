# SPDX-License-Identifier: BSD-3-Clause
"""A map of the plane as a grid of cells, as nav_msgs/OccupancyGrid has it."""

import math
from dataclasses import dataclass, replace
from typing import Any

import cv2
import numpy as np
import numpy.typing as npt

from bubblesim.navigation.planar import Point, heading_of

OCCUPIED = 65  # per cent from which a cell counts as a wall, as map_server has it
FREE = 25  # per cent up to which a cell counts as free
UNKNOWN = -1

Cell = tuple[int, int]
"""Row and column; row 0 is that at the map's origin."""


@dataclass(frozen=True)
class GridMap:
    """Cells hold per cent of occupancy, -1 where nothing is known. Lengths in m, angles in rad."""

    cells: npt.NDArray[np.int8]  # rows x columns
    resolution: float  # of a cell
    origin: tuple[float, float, float] = (0.0, 0.0, 0.0)  # the lower left corner: x, y, heading

    @classmethod
    def from_message(cls, message: Any) -> "GridMap":
        """Of a nav_msgs/OccupancyGrid."""
        info = message.info
        cells = np.asarray(message.data, dtype=np.int8)
        origin = (info.origin.position.x, info.origin.position.y, heading_of(info.origin.orientation))
        return cls(cells.reshape(info.height, info.width), info.resolution, origin)

    @property
    def occupied(self) -> npt.NDArray[np.bool_]:
        """Where there are walls."""
        return self.cells >= OCCUPIED

    @property
    def free(self) -> npt.NDArray[np.bool_]:
        """Where there is surely nothing."""
        return (self.cells >= 0) & (self.cells <= FREE)

    def cell_of(self, point: Point) -> Cell:
        """The cell that a point lies in, which may be outside of the map."""
        x, y, heading = self.origin
        dx, dy = point[0] - x, point[1] - y
        cosine, sine = math.cos(heading), math.sin(heading)
        column = (cosine * dx + sine * dy) / self.resolution
        row = (cosine * dy - sine * dx) / self.resolution
        return math.floor(row), math.floor(column)

    def centre_of(self, cell: Cell) -> Point:
        """The middle of a cell."""
        x, y, heading = self.origin
        along, up = (cell[1] + 0.5) * self.resolution, (cell[0] + 0.5) * self.resolution
        cosine, sine = math.cos(heading), math.sin(heading)
        return x + cosine * along - sine * up, y + sine * along + cosine * up

    def has(self, cell: Cell) -> bool:
        """Whether a cell is one of the map's."""
        rows, columns = self.cells.shape
        return 0 <= cell[0] < rows and 0 <= cell[1] < columns

    def clearance(self) -> npt.NDArray[np.float32]:
        """For each cell, how far it is to the nearest wall."""
        if not self.occupied.any():
            return np.full(self.cells.shape, np.inf, dtype=np.float32)
        open_space = np.where(self.occupied, 0, 255).astype(np.uint8)
        distances: npt.NDArray[np.float32] = cv2.distanceTransform(open_space, cv2.DIST_L2, 5)
        return distances * np.float32(self.resolution)

    def with_obstacles(self, points: list[Point]) -> "GridMap":
        """The same with walls where something has been met."""
        cells = self.cells.copy()
        for cell in map(self.cell_of, points):
            if self.has(cell):
                cells[cell] = 100
        return replace(self, cells=cells)
