# SPDX-License-Identifier: BSD-3-Clause
"""The tricycle's controller: commands for sonar readings."""

import math

import pytest

from bubblesim.controllers.tricycle_avoid import Command, TricycleAvoid, is_reading

STEP = 0.05


def drive(controller: TricycleAvoid, *distances: float | None) -> Command | None:
    """Feed readings one step apart; return the last command."""
    last = None
    for distance in distances:
        last = controller.update(distance, STEP) or last
    return last


def test_turns_and_slows_down_when_something_is_near() -> None:
    command = drive(TricycleAvoid(), 0.99)
    assert command == Command(steering=pytest.approx(math.radians(70.0)), speed=0.5)


def test_one_metre_is_not_near() -> None:
    assert drive(TricycleAvoid(), 1.0).steering == 0.0


def test_straightens_by_five_percent_a_step() -> None:
    command = drive(TricycleAvoid(), 0.5, 2.0, 2.0, 2.0)
    assert command.steering == pytest.approx(math.radians(70.0) * 0.95**3)


def test_speeds_up_by_five_percent_a_step() -> None:
    command = drive(TricycleAvoid(), 0.5, 2.0, 2.0, 2.0)
    assert command.speed == pytest.approx(0.5 * 1.05**3)


def test_never_passes_full_speed() -> None:
    assert drive(TricycleAvoid(), *[math.inf] * 200).speed == 1.0


def test_no_echo_means_free_way() -> None:
    assert drive(TricycleAvoid(), math.inf).speed > 0.5


@pytest.mark.parametrize("distance", [math.nan, -0.1, -math.inf])
def test_ignores_what_is_no_distance(distance: float) -> None:
    assert not is_reading(distance)
    assert TricycleAvoid().update(distance, STEP) is None


def test_stops_after_a_second_of_silence() -> None:
    controller = TricycleAvoid()
    controller.update(2.0, STEP)
    assert controller.update(None, 0.9) is None
    assert controller.update(None, 0.2).speed == 0.0
    assert controller.stopped


def test_reports_only_once_that_it_stopped() -> None:
    controller = TricycleAvoid()
    controller.update(None, 2.0)
    assert controller.update(None, 2.0) is None


def test_readings_that_are_none_count_as_silence() -> None:
    assert drive(TricycleAvoid(), *[math.nan] * 30).speed == 0.0


def test_drives_on_when_the_sonar_is_back() -> None:
    controller = TricycleAvoid()
    controller.update(None, 2.0)
    assert controller.update(2.0, STEP).speed == pytest.approx(0.5 * 1.05)


def test_time_that_jumps_back_does_not_hide_the_silence() -> None:
    controller = TricycleAvoid()
    controller.update(None, -100.0)
    assert controller.update(None, 1.0).speed == 0.0
