# SPDX-License-Identifier: BSD-3-Clause
from dataclasses import dataclass

import pytest

from bubblesim.gazebo_plugins.rate import Rate


@dataclass
class Clock:
    """The attributes of a simulation that a rate reads."""

    time_step: float = 0.05
    state_time: float = 0.0


def due_times(rate: Rate, clock: Clock, steps: int) -> list[float]:
    """Run steps, and return the times at which it is due."""
    times = []
    for _ in range(steps):
        clock.state_time += clock.time_step
        if rate.due():
            times.append(clock.state_time)
    return times


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
def test_in_ten_seconds_it_is_due_as_often_as_its_rate_asks_for(hertz: float, step: float, expected: int) -> None:
    clock = Clock(step)
    assert len(due_times(Rate(hertz, clock), clock, round(10 / step))) == expected


def test_it_is_due_at_multiples_of_its_period() -> None:
    clock = Clock()
    assert due_times(Rate(10, clock), clock, 7) == pytest.approx([0.1, 0.2, 0.3])


def test_it_counts_from_the_time_of_its_creation() -> None:
    clock = Clock(state_time=7.05)
    assert due_times(Rate(5, clock), clock, 9) == pytest.approx([7.25, 7.45])


def test_it_keeps_its_period_after_a_time_without_subscribers() -> None:
    clock = Clock()
    rate = Rate(10, clock)
    clock.state_time = 7.0
    assert due_times(rate, clock, 5) == pytest.approx([7.05, 7.15, 7.25])


@pytest.mark.parametrize(("hertz", "first"), [(1, 1.0), (15, 0.05)])
def test_a_reset_after_time_restarted_starts_the_rate_again(hertz: float, first: float) -> None:
    clock = Clock()
    rate = Rate(hertz, clock)
    due_times(rate, clock, 31)
    clock.state_time = 0.0
    rate.reset()
    assert due_times(rate, clock, 20)[0] == pytest.approx(first)


def test_a_reset_while_time_goes_on_keeps_the_rate() -> None:
    clock = Clock()
    rate = Rate(10, clock)
    due_times(rate, clock, 3)
    rate.reset()
    assert due_times(rate, clock, 3) == pytest.approx([0.2, 0.3])
