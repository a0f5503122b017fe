# SPDX-License-Identifier: BSD-3-Clause
"""Turns in place."""

from bubblesim.navigation.driver import STANDING, Driver, turn, turn_towards


def test_a_turn_has_the_direction_of_the_angle_and_slows_down() -> None:
    driver = Driver(max_turn=0.8)
    assert (turn(1.0, driver).angular, turn(-1.0, driver).angular) == (0.8, -0.8)
    assert turn_towards(0.2, driver).angular == 0.4
    assert turn(0.05, driver) == STANDING


def test_a_robot_that_cannot_turn_in_place_stands() -> None:
    assert turn(1.0, Driver(turning_radius=0.5)) == STANDING
