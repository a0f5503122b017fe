# SPDX-License-Identifier: BSD-3-Clause
"""Exploration: the frontiers between free and unknown cells (Yamauchi 1997)."""

import math
from dataclasses import dataclass, field

import cv2
import numpy as np
import numpy.typing as npt

from bubblesim.navigation.grid_map import UNKNOWN, GridMap
from bubblesim.navigation.path_planning import Footprint, passable
from bubblesim.navigation.planar import Point

SAME = 0.3  # m: viewpoints closer to each other than this are the same


@dataclass(frozen=True)
class Frontier:
    """A connected line of free cells next to unknown ones."""

    length: float  # m
    viewpoint: Point  # the reachable place nearest to its middle
    distance: float  # m, straight line from the robot


def frontiers(grid: GridMap, place: Point, footprint: Footprint, shortest: float) -> list[Frontier]:
    """Return the reachable frontiers of at least the length ``shortest``, the nearest first."""
    reachable = _reachable(grid, place, footprint)
    if not reachable.any():
        return []
    unknown = (grid.cells == UNKNOWN).astype(np.uint8)
    beside_unknown = cv2.dilate(unknown, np.ones((3, 3), np.uint8)) > 0
    edges = (grid.free & beside_unknown).astype(np.uint8)
    count, labels = cv2.connectedComponents(edges, connectivity=8)
    reachable_cells = np.argwhere(reachable)
    found = []
    for label in range(1, count):
        cells = np.argwhere(labels == label)
        length = len(cells) * grid.resolution
        if length < shortest:
            continue
        middle = cells[np.argmin(((cells - cells.mean(axis=0)) ** 2).sum(axis=1))]
        nearest = reachable_cells[np.argmin(((reachable_cells - middle) ** 2).sum(axis=1))]
        viewpoint = grid.centre_of((int(nearest[0]), int(nearest[1])))
        found.append(Frontier(length, viewpoint, math.dist(place, viewpoint)))
    return sorted(found, key=lambda frontier: frontier.distance)


def _reachable(grid: GridMap, place: Point, footprint: Footprint) -> npt.NDArray[np.bool_]:
    """Return the cells connected to the passable cell nearest to the robot."""
    open_cells = passable(grid, footprint)
    if not open_cells.any():
        return open_cells
    _, labels = cv2.connectedComponents(open_cells.astype(np.uint8), connectivity=4)
    candidates = np.argwhere(open_cells)
    nearest = candidates[np.argmin(((candidates - np.array(grid.cell_of(place))) ** 2).sum(axis=1))]
    result: npt.NDArray[np.bool_] = labels == labels[tuple(nearest)]
    return result


@dataclass
class Explorer:
    """Chooses viewpoints until no frontier is left."""

    footprint: Footprint
    shortest: float = 0.2  # m, minimum length of a frontier
    goal: Point | None = None  # where to drive
    rejected: list[Point] = field(default_factory=list)  # viewpoints without new information

    def update(self, grid: GridMap, place: Point) -> bool:
        """Choose a goal if there is none, or if its frontier is known. Return whether the goal has changed."""
        before = self.goal
        seen = [frontier.viewpoint for frontier in frontiers(grid, place, self.footprint, self.shortest)]
        if before is None or all(math.dist(point, before) > SAME for point in seen):
            left = [point for point in seen if all(math.dist(point, other) > SAME for other in self.rejected)]
            self.goal = left[0] if left else None
        return self.goal != before

    def discard_goal(self) -> None:
        """Discard the goal: it is reached or unreachable. A frontier that is still unknown is not tried again."""
        if self.goal is not None:
            self.rejected.append(self.goal)
        self.goal = None
