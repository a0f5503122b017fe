# SPDX-License-Identifier: BSD-3-Clause
"""A map from scans at known poses, like the obstacle layer of move_base's costmap_2d: hits mark, rays clear."""

import numpy as np
import numpy.typing as npt

from bubblesim.controllers.planar_motion import Pose2D
from bubblesim.navigation.grid_map import GridMap
from bubblesim.navigation.planar import Point

Points = npt.NDArray[np.float64]
CLEARED = 4.0  # m: rays clear the map up to this distance


class ScanMap:
    """A grid of fixed size. Cells that no scan has seen are free: a path may lead through them."""

    def __init__(self, resolution: float, corner: Point, size: tuple[float, float]) -> None:
        """Make an empty map.

        :param resolution: of a cell, m.
        :param corner: the lower left one, m, in the frame of the poses.
        :param size: along x and y, m.
        """
        shape = (round(size[1] / resolution), round(size[0] / resolution))
        self.grid = GridMap(np.zeros(shape, dtype=np.int8), resolution, (*corner, 0.0))

    def add(self, pose: Pose2D, hits: list[Point]) -> None:
        """Insert a scan.

        :param pose: of the robot.
        :param hits: the points that it hit, in the robot's frame, m.
        """
        if not hits:
            return
        points = np.array(hits)
        cosine, sine = np.cos(pose.heading), np.sin(pose.heading)
        ends = points @ np.array([[cosine, sine], [-sine, cosine]]) + [pose.x, pose.y]
        cells = self.grid.cells.copy()
        self._clear(cells, np.array([pose.x, pose.y]), ends)
        cells[self._inside(ends)] = 100
        self.grid = GridMap(cells, self.grid.resolution, self.grid.origin)

    def _clear(self, cells: npt.NDArray[np.int8], start: Points, ends: Points) -> None:
        """Mark the cells of the rays as free, up to a cell before their ends."""
        step = self.grid.resolution
        lengths = np.linalg.norm(ends - start, axis=1)
        along = np.arange(0.0, CLEARED, step)
        on_ray = along < (lengths[:, None] - 1.5 * step)
        directions = (ends - start) / lengths[:, None]
        points = start + along[None, :, None] * directions[:, None, :]
        cells[self._inside(points[on_ray])] = 0

    def _inside(self, points: Points) -> tuple[npt.NDArray[np.int_], npt.NDArray[np.int_]]:
        """Return rows and columns of the points that are on the map."""
        indices = np.floor((points - self.grid.origin[:2]) / self.grid.resolution).astype(int)
        rows, columns = indices[:, 1], indices[:, 0]
        on_map = (rows >= 0) & (columns >= 0) & (rows < self.grid.cells.shape[0]) & (columns < self.grid.cells.shape[1])
        return rows[on_map], columns[on_map]
