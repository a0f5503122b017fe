# SPDX-License-Identifier: BSD-3-Clause
"""BubbleRob's controller: its driving directions, and when it yields the wheels."""

import pytest

from bubblesim.controllers.bubblerob import BACK_IN_A_CURVE, FORWARD, BubbleRob, HandOver, Order, Wheel

OWN = "/rosBubbleRob"
HUMAN = "/rostopic_1"


def test_drives_straight_when_nothing_is_sensed() -> None:
    speeds = BubbleRob().update(0.0, sensed=False)
    assert speeds.left == speeds.right > 0.0


def test_backs_off_in_a_curve_when_something_is_sensed() -> None:
    speeds = BubbleRob().update(1.0, sensed=True)
    assert speeds.left < speeds.right < 0.0


def test_backs_off_for_three_seconds_of_simulated_time() -> None:
    controller = BubbleRob()
    controller.update(10.0, sensed=True)
    assert controller.update(12.99, sensed=False) == BACK_IN_A_CURVE
    assert controller.update(13.0, sensed=False) == FORWARD


def test_a_sense_while_backing_off_does_not_prolong_it() -> None:
    controller = BubbleRob()
    controller.update(10.0, sensed=True)
    controller.update(12.0, sensed=True)
    assert controller.update(13.0, sensed=False) == FORWARD


def test_backs_off_again_when_still_sensing_afterwards() -> None:
    controller = BubbleRob()
    controller.update(10.0, sensed=True)
    assert controller.update(13.0, sensed=True) == BACK_IN_A_CURVE
    assert controller.update(15.9, sensed=False) == BACK_IN_A_CURVE


def test_starts_anew_when_the_simulation_does() -> None:
    controller = BubbleRob()
    controller.update(10.0, sensed=True)
    assert controller.update(0.0, sensed=False) == FORWARD


def test_own_messages_are_no_hand_over() -> None:
    hand_over = HandOver(OWN)
    assert hand_over.on_command(Wheel.LEFT, 1.0, OWN) == []
    assert not hand_over.yielded


@pytest.mark.parametrize(("wheel", "other"), [(Wheel.LEFT, Wheel.RIGHT), (Wheel.RIGHT, Wheel.LEFT)])
def test_yields_with_the_others_speed_and_the_other_wheel_stopped(wheel: Wheel, other: Wheel) -> None:
    hand_over = HandOver(OWN)
    assert hand_over.on_command(wheel, 1.5, HUMAN) == [Order(wheel, 1.5), Order(other, 0.0)]
    assert hand_over.yielded


def test_is_silent_once_it_has_yielded() -> None:
    hand_over = HandOver(OWN)
    hand_over.on_command(Wheel.LEFT, 1.0, HUMAN)
    assert hand_over.on_command(Wheel.LEFT, 2.0, HUMAN) == []
    assert hand_over.on_command(Wheel.RIGHT, 3.0, HUMAN) == []


def test_a_second_driver_is_not_answered() -> None:
    hand_over = HandOver(OWN)
    hand_over.on_command(Wheel.LEFT, 1.0, HUMAN)
    assert hand_over.on_command(Wheel.RIGHT, 1.0, "/rostopic_2") == []


def test_drives_on_when_the_other_is_gone() -> None:
    hand_over = HandOver(OWN)
    hand_over.on_command(Wheel.LEFT, 1.0, HUMAN)
    assert not hand_over.set_publishers({OWN, HUMAN})
    assert hand_over.set_publishers({OWN})
    assert not hand_over.yielded


def test_waits_until_the_last_driver_is_gone() -> None:
    hand_over = HandOver(OWN)
    hand_over.on_command(Wheel.LEFT, 1.0, HUMAN)
    hand_over.on_command(Wheel.RIGHT, 1.0, "/rostopic_2")
    assert not hand_over.set_publishers({OWN, HUMAN})
    assert hand_over.set_publishers({OWN})


def test_yields_again_to_one_that_comes_back() -> None:
    hand_over = HandOver(OWN)
    hand_over.on_command(Wheel.LEFT, 1.0, HUMAN)
    hand_over.set_publishers({OWN})
    assert hand_over.on_command(Wheel.RIGHT, 0.0, HUMAN) == [Order(Wheel.RIGHT, 0.0), Order(Wheel.LEFT, 0.0)]
