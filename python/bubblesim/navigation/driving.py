# SPDX-License-Identifier: BSD-3-Clause
"""Navigation to a goal on a map: plan, follow the path around obstacles, back up where none leads on, and replan."""

import math
from dataclasses import dataclass, field

import numpy as np
import numpy.typing as npt

from bubblesim.controllers.planar_motion import Pose2D, Velocity
from bubblesim.navigation.driver import STANDING, Driver, turn, turn_towards
from bubblesim.navigation.grid_map import GridMap
from bubblesim.navigation.local_planning import (
    Arc,
    Body,
    DistanceField,
    best_arc,
    can_turn,
    carrot,
    speed_on,
)
from bubblesim.navigation.path_planning import Footprint, NoPathError, is_clear, plan
from bubblesim.navigation.planar import Point, placed, seen_from

OBSTACLE_RANGE = 3.0  # m: obstacles of the scan within this distance are used for planning
REPLAN = 1.0  # s, minimum time between plans
TURN_FIRST = math.radians(60.0)  # a robot turns in place first, if it can, to a path that is further aside
SHORTEST = 0.1  # m that must be free on an arc
BACKING_SPEED = 0.2  # m/s
BACKING_TIME = 1.5  # s


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
    body: Body | None = None  # the outline; None: a disc with the driver's radius

    def __post_init__(self) -> None:
        """Start without a goal."""
        self._body = self.body or Body(self.driver.radius)
        self._planned_at = -math.inf
        self._reason = ""  # reason why it cannot drive
        self._checked: GridMap | None = None  # the map on which the path is known to be clear
        self._rest(0.0)

    def _rest(self, now: float) -> None:
        self._moved_at = now  # last time it could drive
        self._now = now
        self._speed = 0.0  # m/s, last command
        self._curvature = 0.0  # 1/m, of the last arc
        self._backing_until = -math.inf  # s

    def start(self, goal: Point, now: float, heading: float | None = None) -> None:
        """Start driving to a goal. Only robots that can turn in place turn to a heading."""
        self.goal = goal
        self.heading = heading
        self.path = []
        self._planned_at = -math.inf
        self._rest(now)

    def update(self, pose: Pose2D, now: float) -> Velocity | None:
        """Return the velocity, None without a goal or at the goal. Raise GaveUpError if the goal is unreachable."""
        if self.goal is None:
            return None
        if now < self._now:  # simulated time restarted
            self.start(self.goal, now, self.heading)
        step, self._now = now - self._now, now
        if self._path_is_stale(pose):
            self.path = []
        if self.grid is None:
            self._reason = "no map received yet"
        if not self.path and self.grid is not None and now - self._planned_at >= REPLAN:
            try:
                self._plan(self.grid, pose, now)
            except NoPathError as error:
                self._reason = str(error)
        command = self._command(pose, step) if self.path else STANDING
        if command is None:
            command = STANDING if self.heading is None else self._turn_at_goal(pose, self.heading)
            if command == STANDING:
                self.goal = None
                return None
        self._speed = max(command.linear, 0.0)
        if command.linear > 0.0 or (command != STANDING and self._backing_until < now):
            self._moved_at = now
        elif now - self._moved_at > self.timeout:
            self.goal = None
            raise GaveUpError(self._reason)
        return command

    def _command(self, pose: Pose2D, step: float) -> Velocity | None:
        """Return the velocity along the path; None at its end. Where no arc leads on: a turn, backwards, or zero."""
        if math.dist((pose.x, pose.y), self.path[-1]) <= self.driver.tolerance:
            return None
        nearby = DistanceField.around(self._nearby(pose), self.driver.lookahead + self._body.reach + 0.3)
        if self._now < self._backing_until:
            return self._back_up(nearby)
        point, remaining = carrot(self.path, (pose.x, pose.y), self.driver.lookahead)
        target = seen_from(pose, point)
        aside = math.atan2(target[1], target[0])
        turns = self.driver.turning_radius == 0.0
        if turns and abs(aside) > TURN_FIRST and can_turn(nearby, self._body, aside):
            return turn_towards(aside, self.driver)
        arc = self._arc(pose, nearby)
        if arc is not None and arc.free >= SHORTEST:
            self._curvature = arc.curvature
            faster = self._speed + self.driver.acceleration * max(step, 0.1)
            speed = min(speed_on(arc, self.driver, remaining), faster)
            return Velocity(speed, speed * arc.curvature)
        self._reason = "an obstacle is in the way"
        if turns and abs(aside) > 0.1 and can_turn(nearby, self._body, aside):
            return turn_towards(aside, self.driver)
        if turns and self._now - self._moved_at > BACKING_TIME:
            self._backing_until = self._now + BACKING_TIME
            return self._back_up(nearby)
        if self._now - self._planned_at >= REPLAN:
            self.path = []
        return STANDING

    def _arc(self, pose: Pose2D, nearby: DistanceField) -> Arc | None:
        """Return the best arc to the path: far ahead, or nearer where it bends around obstacles."""
        arc = None
        for ease in (1.0, 0.5, 0.25):
            lookahead = ease * self.driver.lookahead
            point, _ = carrot(self.path, (pose.x, pose.y), lookahead)
            target = seen_from(pose, point)
            if self.driver.turning_radius > 0.0 and target[0] < 0.0:  # behind: turn round
                target = (self.driver.turning_radius, math.copysign(self.driver.turning_radius, target[1]))
            arc = best_arc(target, nearby, self._body, self.driver, self._curvature)
            if arc is not None and arc.miss < 0.25 * lookahead:
                break
        return arc

    def _back_up(self, nearby: DistanceField) -> Velocity:
        arc = best_arc((-0.4, 0.0), nearby, self._body, self.driver, 0.0, reverse=True)
        if arc is None or arc.free < SHORTEST:
            self._backing_until = -math.inf
            self.path = []
            return STANDING
        return Velocity(-BACKING_SPEED, -BACKING_SPEED * arc.curvature)

    def _nearby(self, pose: Pose2D) -> npt.NDArray[np.float64]:
        """Return the obstacles of the scan, and those of the map behind the robot, where the scan may be blind."""
        seen = np.array(self.obstacles, dtype=np.float64).reshape(-1, 2)
        if self.grid is None:
            return seen
        reach = math.ceil((self.driver.lookahead + self._body.reach) / self.grid.resolution)
        row, column = self.grid.cell_of((pose.x, pose.y))
        top, left = max(row - reach, 0), max(column - reach, 0)
        window = self.grid.occupied[top : max(row + reach, 0), left : max(column + reach, 0)]
        places = [self.grid.centre_of((top + int(r), left + int(c))) for r, c in np.argwhere(window)]
        behind = [point for point in (seen_from(pose, place) for place in places) if point[0] < 0.0]
        return np.vstack([seen, np.array(behind).reshape(-1, 2)])

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
