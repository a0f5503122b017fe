# SPDX-License-Identifier: BSD-3-Clause
"""Driving to a goal on a map: plan, follow the path, stop before what is in the way, and plan round it."""

import math
from dataclasses import dataclass, field, replace

from bubblesim.controllers.planar_motion import Pose2D, Velocity
from bubblesim.navigation.grid_map import GridMap
from bubblesim.navigation.path_following import STANDING, Driver, face, follow, is_blocked, turn
from bubblesim.navigation.path_planning import Footprint, NoPathError, is_clear, plan
from bubblesim.navigation.planar import Point, placed

SIGHT = 3.0  # m within which what the scan has met counts for a path
REPLAN = 1.0  # s between paths, at least


class GaveUpError(Exception):
    """The goal cannot be reached: why."""


@dataclass
class Driving:
    """Set `grid` and `obstacles` whenever there are newer ones. Times are in s, of the simulation's clock."""

    driver: Driver
    footprint: Footprint
    patience: float  # s that it waits for a way
    grid: GridMap | None = None
    obstacles: list[Point] = field(default_factory=list)  # as the robot sees them
    goal: Point | None = None
    heading: float | None = None  # rad, at the goal; None: any
    path: list[Point] = field(default_factory=list)

    def __post_init__(self) -> None:
        """Has no goal."""
        self._planned_at = -math.inf
        self._moved_at = 0.0  # when it could drive last
        self._why = ""  # it cannot drive
        self._checked: GridMap | None = None  # the map that the path is known to be clear on

    def start(self, goal: Point, now: float, heading: float | None = None) -> None:
        """Drive there from now on. A heading is only turned to by robots that can turn on the spot."""
        self.goal = goal
        self.heading = heading
        self.path = []
        self._planned_at = -math.inf
        self._moved_at = now

    def update(self, pose: Pose2D, now: float) -> Velocity | None:
        """What to drive at, None without a goal or when it is reached. Raises GaveUpError, and has no goal any more."""
        if self.goal is None:
            return None
        if now < self._planned_at:  # time has started anew
            self.start(self.goal, now, self.heading)
        if self._path_is_stale(pose):
            self.path = []
        if self.grid is None:
            self._why = "no map has come yet"
        if not self.path and self.grid is not None and now - self._planned_at >= REPLAN:
            try:
                self._plan(self.grid, pose, now)
            except NoPathError as error:
                self._why = str(error)
        command = self._command(pose) if self.path else STANDING
        if command is None:
            command = STANDING if self.heading is None else self._turn_at_goal(pose, self.heading)
            if command == STANDING:
                self.goal = None
                return None
        if command != STANDING:
            self._moved_at = now
        elif now - self._moved_at > self.patience:
            self.goal = None
            raise GaveUpError(self._why)
        return command

    def _command(self, pose: Pose2D) -> Velocity | None:
        """As follow(); where something is in the way slower and closer to the path, or a turn, or none at all."""
        for ease in (1.0, 0.5, 0.25):
            driver = replace(
                self.driver, max_speed=ease * self.driver.max_speed, lookahead=ease * self.driver.lookahead
            )
            command = follow(self.path, pose, driver)
            if command is None or not is_blocked(command, self.obstacles, driver):
                return command
        self._why = "something is in the way"
        command = face(self.path, pose, self.driver)
        if command == STANDING:
            self.path = []  # another way has to be found
        return command

    def _turn_at_goal(self, pose: Pose2D, heading: float) -> Velocity:
        return turn(math.remainder(heading - pose.heading, math.tau), self.driver)

    def _path_is_stale(self, pose: Pose2D) -> bool:
        if not self.path or self.grid is None or self.grid is self._checked:
            return False
        self._checked = self.grid
        ahead = [point for point in self.path if math.dist(point, (pose.x, pose.y)) > 2 * self.footprint.radius]
        return not is_clear(self.grid, ahead, self.footprint)

    def _plan(self, grid: GridMap, pose: Pose2D, now: float) -> None:
        assert self.goal is not None
        self._planned_at = now
        met = [placed(pose, point) for point in self.obstacles if math.hypot(*point) < SIGHT]
        self.path = plan(grid.with_obstacles(met), (pose.x, pose.y), self.goal, self.footprint)
        self._checked = grid
