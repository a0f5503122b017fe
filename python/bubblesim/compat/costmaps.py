# SPDX-License-Identifier: BSD-3-Clause
"""Costmaps as costmap_2d publishes them: 100 in obstacles, 99 where the robot would touch one, less further away."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
import numpy.typing as npt
from nav_msgs.msg import OccupancyGrid

from bubblesim.navigation.grid_map import UNKNOWN, GridMap
from bubblesim.navigation.planar import Point

_TOUCHES, _FARTHEST = 99, 98  # per cent


@dataclass(frozen=True)
class Inflation:
    """The parameters of costmap_2d's inflation layer."""

    radius: float  # m, of the robot
    reach: float = 0.55  # m, inflation_radius
    scaling: float = 10.0  # 1/m, cost_scaling_factor

    def costs(self, grid: GridMap) -> npt.NDArray[np.int8]:
        """Return the costs of a grid's cells in per cent, -1 where they are unknown."""
        distance = grid.clearance()
        falling = _FARTHEST * np.exp(-self.scaling * (distance - self.radius))
        costs = np.where(distance <= self.reach, falling, 0.0)
        costs = np.where(distance <= self.radius, _TOUCHES, np.minimum(costs, _FARTHEST))
        costs = np.where((grid.cells == UNKNOWN) & (costs < _TOUCHES), UNKNOWN, costs)
        return np.where(grid.occupied, 100, costs).astype(np.int8)


def rolling_grid(place: Point, size: tuple[float, float], resolution: float, obstacles: list[Point]) -> GridMap:
    """Return the grid around a place, with the obstacles in it; its corner is a multiple of the resolution.

    :param place: m, in the frame of the grid, as are the obstacles.
    :param size: width and height, m.
    """
    shape = max(1, round(size[1] / resolution)), max(1, round(size[0] / resolution))
    corner = [round((at - length / 2) / resolution) * resolution for at, length in zip(place, size, strict=True)]
    return GridMap(np.zeros(shape, np.int8), resolution, (*corner, 0.0)).with_obstacles(obstacles)  # type: ignore[arg-type]


def costmap_message(frame: str, stamp: Any, grid: GridMap, inflation: Inflation) -> Any:
    """Return the nav_msgs/OccupancyGrid of a costmap, whose axes are those of its frame."""
    message = OccupancyGrid()
    message.header.frame_id, message.header.stamp = frame, stamp
    message.info.map_load_time = stamp
    message.info.resolution = grid.resolution
    message.info.height, message.info.width = grid.cells.shape
    message.info.origin.position.x, message.info.origin.position.y = grid.origin[:2]
    message.info.origin.orientation.z, message.info.origin.orientation.w = (
        np.sin(grid.origin[2] / 2),
        np.cos(grid.origin[2] / 2),
    )
    message.data = inflation.costs(grid).ravel().tolist()
    return message
