# SPDX-License-Identifier: BSD-3-Clause
"""Navigation to a goal on a map: plan, follow the path, stop for obstacles, and replan around them."""

import math
from dataclasses import dataclass, field, replace

from bubblesim.controllers.planar_motion import Pose2D, Velocity
from bubblesim.navigation.grid_map import GridMap
from bubblesim.navigation.path_following import STANDING, Driver, face, follow, is_blocked, turn
from bubblesim.navigation.path_planning import Footprint, NoPathError, is_clear, plan
from bubblesim.navigation.planar import Point, placed

OBSTACLE_RANGE = 3.0  # m: obstacles of the scan within this distance are used for planning
REPLAN = 1.0  # s, minimum time between plans


class GaveUpError(Exception):
    """The goal cannot be reached; the text states why."""


@dataclass
class Driving:
    """Set `grid` and `obstacles` when there are new ones. Times are in s, of the simulation's clock."""

    driver: Driver
    footprint: Footprint
    timeout: float  # s to wait for a path before giving up
    grid: GridMap | None = None
    obstacles: list[Point] = field(default_factory=list)  # in the robot's frame
    goal: Point | None = None
    heading: float | None = None  # rad, at the goal; None: any
    path: list[Point] = field(default_factory=list)

    def __post_init__(self) -> None:
        """Start without a goal."""
        self._planned_at = -math.inf
        self._moved_at = 0.0  # last time it could drive
        self._reason = ""  # reason why it cannot drive
        self._checked: GridMap | None = None  # the map on which the path is known to be clear

    def start(self, goal: Point, now: float, heading: float | None = None) -> None:
        """Start driving to a goal. Only robots that can turn on the spot turn to a heading."""
        self.goal = goal
        self.heading = heading
        self.path = []
        self._planned_at = -math.inf
        self._moved_at = now

    def update(self, pose: Pose2D, now: float) -> Velocity | None:
        """Return the velocity, None without a goal or at the goal. Raise GaveUpError if the goal is unreachable."""
        if self.goal is None:
            return None
        if now < self._planned_at:  # simulated time restarted
            self.start(self.goal, now, self.heading)
        if self._path_is_stale(pose):
            self.path = []
        if self.grid is None:
            self._reason = "no map received yet"
        if not self.path and self.grid is not None and now - self._planned_at >= REPLAN:
            try:
                self._plan(self.grid, pose, now)
            except NoPathError as error:
                self._reason = str(error)
        command = self._command(pose) if self.path else STANDING
        if command is None:
            command = STANDING if self.heading is None else self._turn_at_goal(pose, self.heading)
            if command == STANDING:
                self.goal = None
                return None
        if command != STANDING:
            self._moved_at = now
        elif now - self._moved_at > self.timeout:
            self.goal = None
            raise GaveUpError(self._reason)
        return command

    def _command(self, pose: Pose2D) -> Velocity | None:
        """Return the command of follow(); near obstacles slower and closer to the path, or a turn, or zero."""
        for ease in (1.0, 0.5, 0.25):
            driver = replace(
                self.driver, max_speed=ease * self.driver.max_speed, lookahead=ease * self.driver.lookahead
            )
            command = follow(self.path, pose, driver)
            if command is None or not is_blocked(command, self.obstacles, driver):
                return command
        self._reason = "an obstacle is in the way"
        command = face(self.path, pose, self.driver)
        if command == STANDING:
            self.path = []  # replan
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
        met = [placed(pose, point) for point in self.obstacles if math.hypot(*point) < OBSTACLE_RANGE]
        self.path = plan(grid.with_obstacles(met), (pose.x, pose.y), self.goal, self.footprint)
        self._checked = grid
