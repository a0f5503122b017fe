# SPDX-License-Identifier: BSD-3-Clause
"""Where to look next: the frontiers between what is free and what is unknown (Yamauchi 1997)."""

import math
from dataclasses import dataclass, field

import cv2
import numpy as np
import numpy.typing as npt

from bubblesim.navigation.grid_map import UNKNOWN, GridMap
from bubblesim.navigation.path_planning import Footprint, passable
from bubblesim.navigation.planar import Point

SAME = 0.3  # m: viewpoints that are closer to each other count as one


@dataclass(frozen=True)
class Frontier:
    """A line of free cells beside unknown ones."""

    length: float  # m
    viewpoint: Point  # the place nearest to its middle where the robot can be
    distance: float  # m from the robot to there, as the crow flies


def frontiers(grid: GridMap, place: Point, footprint: Footprint, shortest: float) -> list[Frontier]:
    """Frontiers of at least a length that the robot can come to from its place, the nearest first."""
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
    """Cells that hang together with the passable one nearest to the robot."""
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
    """Chooses one viewpoint after the other, until there is nothing left to see."""

    footprint: Footprint
    shortest: float = 0.2  # m of a frontier that is worth going to
    goal: Point | None = None  # where to drive
    in_vain: list[Point] = field(default_factory=list)  # where nothing more was seen

    def update(self, grid: GridMap, place: Point) -> bool:
        """Looks for a goal when there is none, or its frontier is known by now. Returns whether the goal is another."""
        before = self.goal
        seen = [frontier.viewpoint for frontier in frontiers(grid, place, self.footprint, self.shortest)]
        if before is None or all(math.dist(point, before) > SAME for point in seen):
            left = [point for point in seen if all(math.dist(point, other) > SAME for other in self.in_vain)]
            self.goal = left[0] if left else None
        return self.goal != before

    def leave(self) -> None:
        """The robot is at the goal, or cannot come there: what is still unknown from there stays so."""
        if self.goal is not None:
            self.in_vain.append(self.goal)
        self.goal = None
