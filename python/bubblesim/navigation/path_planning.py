# SPDX-License-Identifier: BSD-3-Clause
"""Shortest path through a map for a round robot, by A* (Hart, Nilsson, Raphael 1968) on the map's cells."""

import heapq
import math
from dataclasses import dataclass
from typing import cast

import numpy as np
import numpy.typing as npt

from bubblesim.navigation.grid_map import Cell, GridMap
from bubblesim.navigation.planar import Point

STEPS = [(dr, dc, math.hypot(dr, dc)) for dr in (-1, 0, 1) for dc in (-1, 0, 1) if (dr, dc) != (0, 0)]


class NoPathError(Exception):
    """There is no path to a goal; the text states why."""


@dataclass(frozen=True)
class Footprint:
    """Space needed by a robot, m."""

    radius: float  # minimum distance to walls
    comfort: float  # distance to walls below which a step costs more, up to three times


def passable(grid: GridMap, footprint: Footprint) -> npt.NDArray[np.bool_]:
    """Return the cells where the robot's centre can be."""
    return grid.free & (grid.clearance() > footprint.radius)


def is_clear(grid: GridMap, path: list[Point], footprint: Footprint) -> bool:
    """Return whether a robot can be at all points of a path."""
    if not path:
        return True
    part = grid.around(path, footprint.radius)
    may_pass = passable(part, footprint)
    return all(part.has(cell) and may_pass[cell] for cell in map(part.cell_of, path))


def plan(grid: GridMap, start: Point, goal: Point, footprint: Footprint) -> list[Point]:
    """Return the points of the cheapest path, including start and goal. Raise NoPathError if there is none.

    A robot that is too close to a wall can leave: if its cell is not passable, all cells around it without walls are
    treated as passable.
    """
    first, last = grid.cell_of(start), grid.cell_of(goal)
    clearance = grid.clearance()
    may_pass = grid.free & (clearance > footprint.radius)
    for cell, what in ((first, "the robot"), (last, "the goal")):
        if not grid.has(cell):
            raise NoPathError(f"{what} is outside the map")
    if not may_pass[last]:
        raise NoPathError("the goal is not on a free cell, or too close to a wall")
    _free_start(may_pass, grid, first, footprint.radius)
    closeness = np.clip((footprint.comfort - clearance) / max(footprint.comfort - footprint.radius, 1e-6), 0.0, 1.0)
    cells = _search(may_pass, 1.0 + 2.0 * closeness, first, last)
    return [start, *(grid.centre_of(cell) for cell in cells[1:-1]), goal]


def _free_start(may_pass: npt.NDArray[np.bool_], grid: GridMap, first: Cell, radius: float) -> None:
    reach = math.ceil(2 * radius / grid.resolution)
    rows = slice(max(first[0] - reach, 0), first[0] + reach + 1)
    columns = slice(max(first[1] - reach, 0), first[1] + reach + 1)
    if not may_pass[first]:
        may_pass[rows, columns] |= ~grid.occupied[rows, columns]
    may_pass[first] = True


def _search(may_pass: npt.NDArray[np.bool_], cost: npt.NDArray[np.float64], first: Cell, last: Cell) -> list[Cell]:
    passable_rows = cast("list[list[bool]]", np.pad(may_pass, 1).tolist())  # lists: faster element access
    costs = cast("list[list[float]]", np.pad(cost, 1).tolist())
    start, goal = (first[0] + 1, first[1] + 1), (last[0] + 1, last[1] + 1)  # in the padded map
    best = {start: 0.0}
    came_from: dict[Cell, Cell] = {}
    queue = [(math.dist(start, goal), start)]
    done: set[Cell] = set()
    while queue:
        _, cell = heapq.heappop(queue)
        if cell == goal:
            path = [cell]
            while cell in came_from:
                cell = came_from[cell]
                path.append(cell)
            return [(row - 1, column - 1) for row, column in reversed(path)]
        if cell in done:
            continue
        done.add(cell)
        row, column = cell
        for dr, dc, length in STEPS:
            beside = (row + dr, column + dc)
            if not passable_rows[beside[0]][beside[1]] or beside in done:
                continue
            reached = best[cell] + length * costs[beside[0]][beside[1]]
            if reached < best.get(beside, math.inf):
                best[beside] = reached
                came_from[beside] = cell
                heapq.heappush(queue, (reached + math.dist(beside, goal), beside))
    raise NoPathError("walls or unknown cells separate the robot from the goal")
