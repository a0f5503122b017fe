# SPDX-License-Identifier: BSD-3-Clause
import math

import pytest

from bubblesim.controllers.planar_motion import Pose2D, Velocity, moved
from bubblesim.navigation.path_following import Driver, follow, is_blocked

PIONEER = Driver()
TRICYCLE = Driver(turning_radius=0.5, lookahead=0.8)


def drive(path: list[tuple[float, float]], pose: Pose2D, driver: Driver) -> list[Pose2D]:
    """Return the poses every 0.1 s until the robot, which follows each command at once, has arrived."""
    poses = [pose]
    for _ in range(1000):
        command = follow(path, poses[-1], driver)
        if command is None:
            return poses
        poses.append(moved(poses[-1], command, 0.1))
    pytest.fail("it never arrives")


@pytest.mark.parametrize("driver", [PIONEER, TRICYCLE])
@pytest.mark.parametrize("heading", [0.0, 1.5, 3.1, -2.0])
def test_it_arrives_whichever_way_it_looks(driver: Driver, heading: float) -> None:
    path = [(0.1 * i, 0.0) for i in range(51)]
    poses = drive(path, Pose2D(0.0, 0.0, heading), driver)
    assert math.dist((poses[-1].x, poses[-1].y), path[-1]) <= driver.tolerance


def test_it_stays_on_a_bent_path() -> None:
    path = [(0.1 * i, 0.0) for i in range(30)] + [(3.0, 0.1 * i) for i in range(30)]
    for pose in drive(path, Pose2D(0.0, 0.0, 0.0), PIONEER):
        assert min(math.dist((pose.x, pose.y), point) for point in path) < 0.2


def test_a_point_on_a_circle_is_driven_to_on_that_circle() -> None:
    # The circle of radius 1 to the left through the origin has the point (sin a, 1 - cos a).
    target = (math.sin(0.5), 1 - math.cos(0.5))
    command = follow([target], Pose2D(0, 0, 0), Driver(lookahead=0.1))
    assert command is not None
    assert command.angular / command.linear == pytest.approx(1.0)


def test_limits_are_kept() -> None:
    for angle in (0.0, 0.3, 0.7, 1.5, 3.0):
        for driver in (PIONEER, TRICYCLE):
            command = follow([(2 * math.cos(angle), 2 * math.sin(angle))], Pose2D(0, 0, 0), driver)
            assert command is not None
            assert 0.0 <= command.linear <= driver.max_speed
            assert abs(command.angular) <= driver.max_turn + 1e-9
            if driver is TRICYCLE:
                assert abs(command.angular) <= command.linear / driver.turning_radius + 1e-9


def test_it_slows_down_before_the_end() -> None:
    far, near = (follow([(distance, 0.0)], Pose2D(0, 0, 0), PIONEER) for distance in (2.0, 0.12))
    assert far is not None
    assert near is not None
    assert near.linear == pytest.approx(math.sqrt(2 * 0.4 * 0.12))
    assert near.linear < far.linear == PIONEER.max_speed


@pytest.mark.parametrize(
    ("command", "point", "blocked"),
    [
        (Velocity(0.4, 0.0), (0.5, 0.0), True),
        (Velocity(0.4, 0.0), (0.5, 0.31), False),  # at the side
        (Velocity(0.4, 0.0), (0.7, 0.0), False),  # far enough to stop: 0.3 + 0.1 + 0.2 m
        (Velocity(0.1, 0.0), (0.5, 0.0), False),  # slow
        (Velocity(0.4, 0.0), (-0.2, 0.0), False),  # behind
        (Velocity(0.0, 0.5), (0.2, 0.0), False),  # turning on the spot
        (Velocity(0.4, 0.8), (0.5, 0.5), True),  # on the curve: 0.25 m to the left there
        (Velocity(0.4, 0.8), (0.5, -0.2), False),
    ],
)
def test_what_is_in_the_way_blocks(command: Velocity, point: tuple[float, float], blocked: bool) -> None:
    assert is_blocked(command, [point], PIONEER) is blocked
