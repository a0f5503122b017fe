# SPDX-License-Identifier: BSD-3-Clause
import pytest

from bubblesim.gazebo_plugins.rate import Rate


@pytest.mark.parametrize(
    ("hertz", "step", "expected"),
    [
        (0, 0.05, 200),  # every step
        (100, 0.05, 200),  # more often than steps
        (10, 0.05, 100),
        (20, 0.05, 200),
        (15, 0.05, 150),
        (30, 0.01, 300),
        (1, 0.05, 10),
    ],
)
def test_in_ten_seconds_it_is_due_as_often_as_its_rate_says(hertz: float, step: float, expected: int) -> None:
    rate = Rate(hertz, step)
    assert sum(rate.due(index * step) for index in range(round(10 / step))) == expected


def test_time_that_starts_again_finds_it_due() -> None:
    rate = Rate(1, 0.05)
    assert rate.due(7.0)
    assert not rate.due(0.0)
    rate.reset()
    assert rate.due(0.0)
