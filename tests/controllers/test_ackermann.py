# SPDX-License-Identifier: BSD-3-Clause
import math

import pytest
from hypothesis import given
from hypothesis import strategies as st

from bubblesim.controllers.ackermann import front_wheel_angles, rear_wheel_speeds

WHEELBASE, TRACK = 2.5, 1.5  # m


def test_ahead_all_wheels_are_parallel() -> None:
    assert front_wheel_angles(WHEELBASE, TRACK, 0.0) == (0.0, 0.0)
    assert rear_wheel_speeds(WHEELBASE, TRACK, 3.0, 0.0) == (3.0, 3.0)


@given(st.floats(0.01, 0.9))
def test_all_axles_meet_in_one_point(angle: float) -> None:
    radius = WHEELBASE / math.tan(angle)  # m, from the middle of the rear axle to the left
    left, right = front_wheel_angles(WHEELBASE, TRACK, angle)
    assert math.tan(left) * (radius - TRACK / 2) == pytest.approx(WHEELBASE)
    assert math.tan(right) * (radius + TRACK / 2) == pytest.approx(WHEELBASE)
    assert front_wheel_angles(WHEELBASE, TRACK, -angle) == pytest.approx((-right, -left))
    slow, fast = rear_wheel_speeds(WHEELBASE, TRACK, 1.0, angle)
    assert (slow, fast) == pytest.approx(((radius - TRACK / 2) / radius, (radius + TRACK / 2) / radius))
