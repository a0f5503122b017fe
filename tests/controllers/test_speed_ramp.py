# SPDX-License-Identifier: BSD-3-Clause
import pytest

from bubblesim.controllers.speed_ramp import SpeedRamp


def test_speeds_change_by_the_acceleration_until_they_are_there() -> None:
    ramp = SpeedRamp(2.0, (0.0, 1.0))
    assert ramp.update((1.0, -1.0), 0.25) == pytest.approx((0.5, 0.5))
    assert ramp.update((0.6, -1.0), 0.25) == pytest.approx((0.6, 0.0))


def test_no_acceleration_sets_no_limit() -> None:
    assert SpeedRamp(0.0, (0.0,)).update((9.0,), 0.01) == (9.0,)
