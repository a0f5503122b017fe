# SPDX-License-Identifier: BSD-3-Clause
"""Driving on a map with obstacles that are not in it; the robot follows each command at once."""

import math
from collections.abc import Callable

import pytest

from bubblesim.controllers.planar_motion import Pose2D, moved
from bubblesim.navigation.driver import Driver
from bubblesim.navigation.driving import Driving, GaveUpError
from bubblesim.navigation.grid_map import GridMap
from bubblesim.navigation.path_planning import Footprint
from bubblesim.navigation.planar import Point, seen_from
from rooms import drawn

ROOM = drawn("#" * 60 + "\n" + ("#" + " " * 58 + "#\n") * 38 + "#" * 60, resolution=0.1)
START = Pose2D(1.0, 2.0, 0.0)
GOAL = (5.0, 2.0)


def driving(grid: GridMap | None = ROOM, driver: Driver | None = None) -> Driving:
    driver = driver or Driver(radius=0.25)
    return Driving(driver, Footprint(0.3, 0.6), timeout=10.0, grid=grid)


def box(x: float, y: float) -> list[Point]:
    """Return points on an obstacle of 0.4 by 0.4 m."""
    steps = [0.05 * i - 0.2 for i in range(9)]
    return [(x + a, y + b) for a in steps for b in steps if max(abs(a), abs(b)) > 0.19]


def drive(
    pilot: Driving, things: list[Point], meanwhile: Callable[[float], None] = lambda now: None
) -> tuple[Pose2D, float]:
    """Return the final pose, and the smallest distance of the robot's centre to an obstacle."""
    pose, closest = START, math.inf
    for step in range(1500):
        now = 0.1 * step
        meanwhile(now)
        pilot.obstacles = [seen_from(pose, thing) for thing in things]
        command = pilot.update(pose, now)
        if command is None:
            return pose, closest
        pose = moved(pose, command, 0.1)
        closest = min([closest, *(math.dist((pose.x, pose.y), thing) for thing in things)])
    pytest.fail("it never arrives")


@pytest.mark.parametrize("driver", [Driver(radius=0.25), Driver(radius=0.25, turning_radius=0.4, lookahead=0.6)])
def test_it_comes_to_its_goal(driver: Driver) -> None:
    pilot = driving(driver=driver)
    pilot.start(GOAL, 0.0)
    end, _ = drive(pilot, [])
    assert math.dist((end.x, end.y), GOAL) <= driver.tolerance
    assert pilot.goal is None


@pytest.mark.parametrize("heading", [-3.0, 0.0, 1.5])
def test_it_turns_to_the_heading_that_is_asked_for(heading: float) -> None:
    pilot = driving()
    pilot.start(GOAL, 0.0, heading)
    end, _ = drive(pilot, [])
    assert math.dist((end.x, end.y), GOAL) <= pilot.driver.tolerance
    assert abs(math.remainder(end.heading - heading, math.tau)) <= 0.1


def test_it_goes_round_what_is_not_in_the_map() -> None:
    pilot = driving()
    pilot.start(GOAL, 0.0)
    end, closest = drive(pilot, box(3.0, 2.0))
    assert math.dist((end.x, end.y), GOAL) <= pilot.driver.tolerance
    assert closest > 0.25


def test_it_stops_before_what_closes_the_way_and_gives_up_at_last() -> None:
    pilot = driving()
    pilot.start(GOAL, 0.0)
    wall = [(3.0, 0.1 * i) for i in range(41)]
    with pytest.raises(GaveUpError, match="walls"):
        drive(pilot, wall)
    assert pilot.goal is None
    assert pilot.update(START, 200.0) is None


def test_it_waits_for_a_map() -> None:
    pilot = driving(grid=None)
    pilot.start(GOAL, 0.0)

    def bring_map(now: float) -> None:
        pilot.grid = ROOM if now > 5.0 else None

    end, _ = drive(pilot, [], bring_map)
    assert math.dist((end.x, end.y), GOAL) <= pilot.driver.tolerance


def test_it_plans_anew_when_the_map_shows_a_wall_on_the_path() -> None:
    pilot = driving()
    pilot.start(GOAL, 0.0)
    pilot.update(START, 0.0)
    before = pilot.path
    pilot.grid = ROOM.with_obstacles([(3.0, 0.1 * i) for i in range(5, 36)])
    pilot.update(START, 2.0)
    assert before != pilot.path
    assert all(math.dist(point, (3.0, 2.0)) > 0.3 for point in pilot.path)


def test_without_a_goal_it_stands() -> None:
    assert driving().update(START, 0.0) is None


def test_time_that_starts_anew_does_not_stop_it() -> None:
    pilot = driving()
    pilot.start(GOAL, 1000.0)
    pilot.update(START, 1000.0)
    command = pilot.update(START, 1.0)
    assert command is not None
    assert command.linear > 0.0
