# SPDX-License-Identifier: BSD-3-Clause
"""The tricycle's kinematics, compared with geometry."""

import math

import pytest
from hypothesis import given
from hypothesis import strategies as st

from bubblesim.controllers.planar_motion import Pose2D, Velocity, moved
from bubblesim.controllers.tricycle_drive import FrontWheel, Tricycle, front_wheel, velocity

TRICYCLE = Tricycle(wheelbase=1.0, wheel_radius=0.3, max_steering=1.5, max_speed=100.0)


def test_straight_on_turns_the_wheel_by_speed_over_radius() -> None:
    assert front_wheel(TRICYCLE, Velocity(0.6, 0.0)) == FrontWheel(steering=0.0, speed=pytest.approx(2.0))


def test_on_a_circle_the_wheel_points_along_its_own_larger_circle() -> None:
    # Rear axle on a circle of radius 2 m: the front wheel, 1 m ahead, is on a circle of radius sqrt(5) m.
    wheel = front_wheel(TRICYCLE, Velocity(1.0, 0.5))
    assert wheel.steering == pytest.approx(math.atan(1.0 / 2.0))
    assert wheel.speed == pytest.approx(0.5 * math.sqrt(5.0) / 0.3)


def test_backwards_to_the_left_steers_to_the_right() -> None:
    wheel = front_wheel(TRICYCLE, Velocity(-1.0, 0.5))
    assert wheel.steering == pytest.approx(-math.atan(0.5))
    assert wheel.speed < 0.0


@pytest.mark.parametrize("angular", [0.5, -0.5])
def test_turning_in_place_steers_as_far_as_it_can(angular: float) -> None:
    wheel = front_wheel(TRICYCLE, Velocity(0.0, angular))
    assert wheel.steering == math.copysign(1.5, angular)
    assert wheel.speed == pytest.approx(0.5 * math.sin(1.5) / 0.3)


def test_standing_still_leaves_the_wheel_where_it_is() -> None:
    assert front_wheel(TRICYCLE, Velocity(0.0, 0.0), steering_now=0.7) == FrontWheel(steering=0.7, speed=0.0)


def test_speed_is_limited_on_the_same_curve() -> None:
    slow = Tricycle(max_speed=2.0)
    wheel = front_wheel(slow, Velocity(5.0, 2.5))
    assert wheel.speed == 2.0
    assert velocity(slow, wheel).angular / velocity(slow, wheel).linear == pytest.approx(0.5)


@pytest.mark.parametrize("bad", [Velocity(math.nan, 0.0), Velocity(0.0, math.inf)])
def test_velocities_that_are_not_finite_are_refused(bad: Velocity) -> None:
    with pytest.raises(ValueError, match="must be finite"):
        front_wheel(TRICYCLE, bad)


@pytest.mark.parametrize("bad", [{"wheelbase": 0.0}, {"wheel_radius": math.nan}, {"max_steering": 2.0}])
def test_tricycles_that_cannot_be_are_refused(bad: dict[str, float]) -> None:
    with pytest.raises(ValueError, match=next(iter(bad))):
        Tricycle(**bad)


linear = st.floats(0.01, 10.0) | st.floats(-10.0, -0.01)


@given(linear, st.floats(-0.1, 0.1))
def test_the_wheel_that_gives_a_velocity_gives_that_velocity(forward: float, angular: float) -> None:
    wanted = Velocity(forward, angular)
    found = velocity(TRICYCLE, front_wheel(TRICYCLE, wanted))
    assert found.linear == pytest.approx(wanted.linear)
    assert found.angular == pytest.approx(wanted.angular)


def test_a_quarter_of_a_circle_ends_where_geometry_puts_it() -> None:
    end = moved(Pose2D(), Velocity(linear=1.0, angular=0.5), dt=math.pi)
    assert (end.x, end.y, end.heading) == pytest.approx((2.0, 2.0, math.pi / 2))


def test_small_steps_add_up_to_one_large_step() -> None:
    pose = Pose2D(1.0, 2.0, 3.0)
    once = moved(pose, Velocity(0.7, -0.3), 2.0)
    for _ in range(100):
        pose = moved(pose, Velocity(0.7, -0.3), 0.02)
    assert (pose.x, pose.y, pose.heading) == pytest.approx((once.x, once.y, once.heading))
