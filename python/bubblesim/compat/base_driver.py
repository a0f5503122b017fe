# SPDX-License-Identifier: BSD-3-Clause
"""Drives to the goals of move_base: go_to.py's navigation, with a map of its own and recovery behaviours."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import replace

import numpy as np

from bubblesim.compat.move_base_settings import ObstacleLayer, Settings
from bubblesim.compat.recovery import Recoveries, Recovery, RecoveryKind, Rotation
from bubblesim.controllers.planar_motion import Pose2D, Velocity
from bubblesim.navigation.driver import STANDING
from bubblesim.navigation.driving import Driving, GaveUpError
from bubblesim.navigation.grid_map import GridMap
from bubblesim.navigation.local_planning import Body
from bubblesim.navigation.planar import Point
from bubblesim.navigation.scan_map import ScanMap

_SAME_PLACE, _SAME_HEADING = 0.01, 0.01  # m, rad: a goal that is sent again
_ROLLS_AFTER = 0.25  # of the width: how far the robot moves in a rolling map before it is shifted


class ObstacleMap:
    """What scans have seen, as costmap_2d's obstacle layer; around the robot if it rolls."""

    def __init__(self, layer: ObstacleLayer) -> None:
        """Begin with an empty map."""
        self._layer = layer
        self._map = ScanMap(layer.resolution, layer.corner, layer.size)
        self._updated = -math.inf  # s

    @property
    def grid(self) -> GridMap:
        """The map."""
        return self._map.grid

    def add(self, pose: Pose2D, hits: list[Point], now: float) -> None:
        """Insert a scan, at most at the rate of the layer; ``hits`` in the robot's frame."""
        if 0.0 <= now - self._updated < 1.0 / self._layer.frequency:
            return
        self._updated = now
        self._roll(pose)
        self._map.add(pose, hits)

    def clear(self) -> None:
        """Forget all obstacles."""
        grid = self._map.grid
        self._map.grid = replace(grid, cells=np.zeros_like(grid.cells))

    def clear_beyond(self, place: Point, distance: float) -> None:
        """Forget the obstacles outside of a square with twice the distance as its side."""
        grid = self._map.grid
        row, column = grid.cell_of(place)
        reach = math.ceil(distance / grid.resolution)
        rows, columns = slice(max(row - reach, 0), row + reach + 1), slice(max(column - reach, 0), column + reach + 1)
        cells = np.zeros_like(grid.cells)
        cells[rows, columns] = grid.cells[rows, columns]
        self._map.grid = replace(grid, cells=cells)

    def _roll(self, pose: Pose2D) -> None:
        grid = self._map.grid
        middle = [corner + size / 2 for corner, size in zip(grid.origin, self._layer.size, strict=False)]
        moved = (pose.x - middle[0]) / grid.resolution, (pose.y - middle[1]) / grid.resolution
        most = _ROLLS_AFTER * min(self._layer.size) / grid.resolution
        if not self._layer.rolls or max(map(abs, moved)) < most:
            return
        columns, rows = round(moved[0]), round(moved[1])
        height, width = grid.cells.shape
        cells = np.zeros_like(grid.cells)
        if abs(rows) < height and abs(columns) < width:
            kept = grid.cells[max(rows, 0) : height + min(rows, 0), max(columns, 0) : width + min(columns, 0)]
            top, left = max(-rows, 0), max(-columns, 0)
            cells[top : top + kept.shape[0], left : left + kept.shape[1]] = kept
        x, y = grid.origin[0] + columns * grid.resolution, grid.origin[1] + rows * grid.resolution
        self._map.grid = replace(grid, cells=cells, origin=(x, y, 0.0))


class BaseDriver:
    """One goal at a time. Times are those of the simulation, s; `log` gets a line for each recovery."""

    def __init__(self, settings: Settings, log: Callable[[str], None]) -> None:
        """Begin without a goal."""
        self._settings = settings
        self._log = log
        self.driving = Driving(settings.driver, settings.footprint, settings.timeout, body=settings.body)
        self.obstacles = None if settings.obstacle_layer is None else ObstacleMap(settings.obstacle_layer)
        self._recoveries = Recoveries(settings.recoveries, settings.oscillation_distance)
        self._rotation: Rotation | None = None
        self._goal: tuple[Point, float | None] | None = None
        self._waits_at: tuple[Point, float] | None = None  # where and since when it has not moved on

    def start(self, goal: Point, heading: float | None, now: float) -> None:
        """Drive to a goal; one that is sent again does not begin anew."""
        if self._goal is not None and self.driving.goal is not None and _is_same(self._goal, (goal, heading)):
            return
        self._goal = goal, heading
        self._rotation = None
        self._waits_at = None
        self._recoveries.restart()
        self.driving.start(goal, now, heading)

    def stop(self) -> None:
        """Give up the goal."""
        self.driving.goal = self._goal = self._rotation = None

    def see(self, pose: Pose2D, hits: list[Point], now: float) -> None:
        """Take the newest scan; ``hits`` in the robot's frame, m."""
        self.driving.obstacles = hits
        if self.obstacles is not None:
            self.obstacles.add(pose, hits, now)
            self.driving.grid = self.obstacles.grid

    def update(self, pose: Pose2D, now: float) -> Velocity | None:
        """Return the velocity, None at the goal. Raise GaveUpError when no recovery is left."""
        place = pose.x, pose.y
        self._recoveries.moved_to(place)
        if self._rotation is not None:
            command = self._rotation.update(pose, self.driving.obstacles)
            if command != STANDING:
                return command
            self._rotation = None
            self._restart(now)
        try:
            self._check_oscillation(place, now)
            return self.driving.update(pose, now)
        except GaveUpError as error:
            recovery = self._recoveries.take(place)
            if recovery is None:
                raise
            self._log(f"{error}: recovery behavior {recovery.name}")
            self._recover(recovery, pose, now)
            return STANDING

    def _recover(self, recovery: Recovery, pose: Pose2D, now: float) -> None:
        self._restart(now)
        if recovery.kind == RecoveryKind.ROTATE:
            self._rotation = Rotation(
                self._settings.driver, self._settings.body or Body(self._settings.driver.radius), pose
            )
        elif self.obstacles is not None:
            self.obstacles.clear_beyond((pose.x, pose.y), recovery.distance)
            self.driving.grid = self.obstacles.grid

    def _restart(self, now: float) -> None:
        self._waits_at = None
        if self._goal is not None:
            self.driving.start(self._goal[0], now, self._goal[1])

    def _check_oscillation(self, place: Point, now: float) -> None:
        timeout = self._settings.oscillation_timeout
        if self._waits_at is None or math.dist(place, self._waits_at[0]) > self._settings.oscillation_distance:
            self._waits_at = place, now
        elif timeout > 0.0 and now - self._waits_at[1] > timeout:
            self.driving.goal = None
            raise GaveUpError(f"the robot has not moved on for {timeout:g} s")


def _is_same(goal: tuple[Point, float | None], other: tuple[Point, float | None]) -> bool:
    headings = goal[1], other[1]
    if math.dist(goal[0], other[0]) > _SAME_PLACE or (headings[0] is None) != (headings[1] is None):
        return False
    return abs(math.remainder((headings[0] or 0.0) - (headings[1] or 0.0), math.tau)) < _SAME_HEADING
