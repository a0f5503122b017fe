# SPDX-License-Identifier: BSD-3-Clause
"""The driver of move_base with a robot that follows each command at once: recoveries, and its map of scans."""

import math

import pytest

from bubblesim.compat.base_driver import BaseDriver, ObstacleMap
from bubblesim.compat.move_base_settings import ObstacleLayer, Settings
from bubblesim.controllers.planar_motion import Pose2D, moved
from bubblesim.navigation.driver import Driver
from bubblesim.navigation.driving import GaveUpError
from bubblesim.navigation.path_planning import Footprint
from bubblesim.navigation.planar import Point, seen_from

STEP = 0.1  # s
LAYER = ObstacleLayer(size=(12.0, 12.0), corner=(-6.0, -6.0), resolution=0.1, frequency=10.0)
DRIVER = Driver(max_speed=0.5, acceleration=1.0, radius=0.2)
# A wall across the map at x = 1, as points every 5 cm.
WALL: list[Point] = [(1.0, 0.05 * index) for index in range(-130, 130)]


class Run:
    """A robot that starts at the origin."""

    def __init__(self, settings: Settings) -> None:
        self.log: list[str] = []
        self.driver = BaseDriver(settings, self.log.append)
        self.pose = Pose2D()
        self.now = 0.0
        self.turned = 0.0
        self.is_held = False  # it does not follow its commands

    def step(self, obstacles: list[Point]) -> bool:
        """Return whether it is at the goal."""
        self.now += STEP
        seen = [seen_from(self.pose, point) for point in obstacles]
        self.driver.see(self.pose, [point for point in seen if math.hypot(*point) < 6.0], self.now)
        command = self.driver.update(self.pose, self.now)
        if command is None:
            return True
        self.turned += abs(command.angular) * STEP
        self.pose = self.pose if self.is_held else moved(self.pose, command, STEP)
        return False

    def on(self, obstacles: list[Point], steps: int) -> None:
        """Go on until the goal, for this number of steps at most."""
        for _ in range(steps):
            if self.step(obstacles):
                return


def settings(**given: object) -> Settings:
    basis = {"driver": DRIVER, "footprint": Footprint(0.25, 0.5), "obstacle_layer": LAYER, "timeout": 2.0}
    return Settings(**{**basis, **given})  # type: ignore[arg-type]


def test_it_drives_on_a_map_of_what_it_sees() -> None:
    run = Run(settings())
    run.driver.start((3.0, 0.0), None, 0.0)
    post = [(1.5 + 0.1 * math.cos(angle / 10), 0.1 * math.sin(angle / 10)) for angle in range(63)]
    nearest = math.inf
    for _ in range(400):
        if run.step(post):
            break
        nearest = min(nearest, math.dist((run.pose.x, run.pose.y), (1.5, 0.0)))
    assert math.dist((run.pose.x, run.pose.y), (3.0, 0.0)) < 0.11
    assert nearest > 0.3  # their radii
    assert run.log == []


def test_recoveries_follow_one_another_until_the_goal_is_given_up() -> None:
    run = Run(settings())
    run.driver.start((3.0, 0.0), None, 0.0)
    with pytest.raises(GaveUpError, match="separate the robot from the goal"):
        run.on(WALL, steps=2000)
    assert [line.rpartition(" ")[2] for line in run.log] == [
        "conservative_reset", "rotate_recovery", "aggressive_reset", "aggressive_rotate"]  # fmt: skip
    assert run.turned == pytest.approx(2 * math.tau, rel=0.05), "it turns around twice"


def test_a_wall_that_has_gone_is_forgotten_by_a_recovery() -> None:
    # Rays without a hit clear nothing. What is further away than 3 m is forgotten first: it drives round the rest.
    run = Run(settings())
    run.driver.start((3.0, 0.0), None, 0.0)
    for _ in range(10):
        run.step(WALL)
    run.on([], steps=600)
    assert math.dist((run.pose.x, run.pose.y), (3.0, 0.0)) < 0.11
    assert [line.rpartition(" ")[2] for line in run.log] == ["conservative_reset"]


def test_a_robot_that_does_not_move_on_recovers() -> None:
    run = Run(settings(oscillation_timeout=3.0, recoveries=()))
    run.driver.start((3.0, 0.0), None, 0.0)
    run.is_held = True
    with pytest.raises(GaveUpError, match="has not moved on for 3 s"):
        run.on([], steps=100)


def test_a_goal_that_is_sent_again_does_not_begin_anew() -> None:
    run = Run(settings())
    run.driver.start((3.0, 0.0), 1.0, 0.0)
    run.step([])
    path = run.driver.driving.path
    assert path
    run.driver.start((3.0, 0.001), 1.001, run.now)
    assert run.driver.driving.path is path
    run.driver.start((3.0, 0.5), 1.0, run.now)
    assert run.driver.driving.path == []


def cells(seen: ObstacleMap) -> set[tuple[float, float]]:
    """Return the centres of the occupied cells."""
    grid = seen.grid
    return {
        (round(x, 3), round(y, 3))
        for x, y in (
            grid.centre_of((int(row), int(column))) for row, column in zip(*grid.occupied.nonzero(), strict=True)
        )
    }


def test_a_rolling_map_keeps_obstacles_where_they_are() -> None:
    seen = ObstacleMap(ObstacleLayer((4.0, 4.0), (-2.0, -2.0), 0.1, rolls=True, frequency=10.0))
    seen.add(Pose2D(), [(1.55, 0.55), (-1.45, 0.05)], 1.0)
    assert cells(seen) == {(1.55, 0.55), (-1.45, 0.05)}
    seen.add(Pose2D(1.2, 0.0), [], 2.0)
    assert cells(seen) == {(1.55, 0.55)}, "what it has left behind is forgotten"
    assert seen.grid.origin[0] == pytest.approx(-0.8)
    seen.add(Pose2D(50.0, 0.0), [], 3.0)
    assert cells(seen) == set()


def test_a_map_is_cleared_beyond_a_distance() -> None:
    seen = ObstacleMap(LAYER)
    seen.add(Pose2D(1.0, 1.0), [(0.55, 0.05), (3.05, 0.05)], 1.0)
    seen.clear_beyond((1.0, 1.0), 2.0)
    assert cells(seen) == {(1.55, 1.05)}
    seen.clear()
    assert cells(seen) == set()
