# SPDX-License-Identifier: BSD-3-Clause
"""The kinematics of two driven wheels, compared with geometry."""

import math
import random
import statistics

import pytest
from hypothesis import given
from hypothesis import strategies as st

from bubblesim.controllers.differential_drive import DifferentialDrive, WheelOdometry, Wheels, velocity, wheel_speeds
from bubblesim.controllers.planar_motion import Velocity

DRIVE = DifferentialDrive(wheel_radius=0.1, track=0.4)


def test_in_place_the_wheels_turn_against_each_other() -> None:
    # A quarter turn per second moves each wheel along a quarter circle of radius 0.2 m.
    wheels = wheel_speeds(DRIVE, Velocity(0.0, math.pi / 2))
    assert (wheels.left, wheels.right) == pytest.approx((-math.pi, math.pi))


def test_what_is_too_fast_is_followed_slower_on_the_same_curve() -> None:
    slow = DifferentialDrive(wheel_radius=0.1, track=0.4, max_speed=2.0)
    wheels = wheel_speeds(slow, Velocity(10.0, 5.0))
    assert max(wheels.left, wheels.right) == pytest.approx(2.0)
    assert velocity(slow, wheels).angular / velocity(slow, wheels).linear == pytest.approx(0.5)


@given(st.floats(-10.0, 10.0), st.floats(-10.0, 10.0))
def test_the_wheels_that_give_a_velocity_give_that_velocity(linear: float, angular: float) -> None:
    found = velocity(DRIVE, wheel_speeds(DRIVE, Velocity(linear, angular)))
    assert (found.linear, found.angular) == pytest.approx((linear, angular))


@pytest.mark.parametrize("bad", [Velocity(math.nan, 0.0), Velocity(0.0, -math.inf)])
def test_velocities_that_are_not_finite_are_refused(bad: Velocity) -> None:
    with pytest.raises(ValueError, match="must be finite"):
        wheel_speeds(DRIVE, bad)


@pytest.mark.parametrize("bad", [{"wheel_radius": 0.0, "track": 1.0}, {"wheel_radius": 1.0, "track": math.nan}])
def test_drives_that_cannot_be_are_refused(bad: dict[str, float]) -> None:
    with pytest.raises(ValueError, match="must be above 0"):
        DifferentialDrive(**bad)


def test_encoders_that_count_from_minus_pi_to_pi_measure_a_circle() -> None:
    odometry = WheelOdometry(DRIVE, Wheels(0.0, 0.0))
    # 0.8 m/s left and 1.2 m/s right give 1 m/s along a circle of radius 1 m, one turn in 2 pi seconds.
    steps = 628
    for i in range(1, steps + 1):
        time = 2 * math.pi * i / steps
        angles = Wheels(math.remainder(8.0 * time, math.tau), math.remainder(12.0 * time, math.tau))
        odometry.update(angles, 2 * math.pi / steps)
        if i == steps // 2:
            assert (odometry.pose.x, odometry.pose.y) == pytest.approx((0.0, 2.0), abs=1e-9)
    assert (odometry.pose.x, odometry.pose.y) == pytest.approx((0.0, 0.0), abs=1e-9)
    assert (odometry.velocity.linear, odometry.velocity.angular) == pytest.approx((1.0, 1.0))


def test_an_error_is_a_part_of_each_step() -> None:
    numbers = random.Random(1)
    odometry = WheelOdometry(DRIVE, Wheels(0.0, 0.0), error=lambda: numbers.gauss(0.0, 0.05))
    speeds = []
    for i in range(1, 4001):
        odometry.update(Wheels(0.1 * i, 0.1 * i), 0.1)
        speeds.append(odometry.velocity.linear)
    # The mean of two wheels at 0.1 m/s, each off by 5 %.
    assert statistics.mean(speeds) == pytest.approx(0.1, rel=0.002)
    assert statistics.stdev(speeds) == pytest.approx(0.1 * 0.05 / math.sqrt(2.0), rel=0.05)
