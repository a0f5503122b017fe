# SPDX-License-Identifier: BSD-3-Clause
"""Commands of the keys."""

import pytest

from bubblesim.controllers.base_velocity import STANDING, BaseVelocity
from bubblesim.teleop.keyboard_teleop import KeyboardTeleop


@pytest.mark.parametrize(
    ("key", "velocity"),
    [
        ("i", BaseVelocity(0.5, 0, 0)),
        (",", BaseVelocity(-0.5, 0, 0)),
        ("j", BaseVelocity(0, 0, 1)),
        ("l", BaseVelocity(0, 0, -1)),
        ("u", BaseVelocity(0.5, 0, 1)),
        ("o", BaseVelocity(0.5, 0, -1)),
        ("m", BaseVelocity(-0.5, 0, -1)),
        (".", BaseVelocity(-0.5, 0, 1)),
        ("J", BaseVelocity(0, 0.5, 0)),
        (">", BaseVelocity(-0.5, -0.5, 0)),
        ("k", STANDING),
        ("#", STANDING),
    ],
)
def test_a_key_has_its_direction(key: str, velocity: BaseVelocity) -> None:
    teleop = KeyboardTeleop(speed=0.5, turn=1.0)
    teleop.press("i", now=0.0)
    teleop.press(key, now=0.0)
    assert teleop.velocity(now=0.1) == velocity


def test_stops_when_no_key_is_pressed_any_more() -> None:
    teleop = KeyboardTeleop(timeout=0.6)
    teleop.press("i", now=10.0)
    assert teleop.velocity(now=10.6) != STANDING
    assert teleop.velocity(now=10.7) == STANDING


def test_goes_on_without_a_timeout() -> None:
    teleop = KeyboardTeleop(timeout=None)
    teleop.press("i", now=0.0)
    assert teleop.velocity(now=1000.0) != STANDING


@pytest.mark.parametrize(
    ("key", "speed", "turn"),
    [("q", 1.1, 1.1), ("z", 1 / 1.1, 1 / 1.1), ("w", 1.1, 1), ("x", 1 / 1.1, 1), ("e", 1, 1.1), ("c", 1, 1 / 1.1)],
)
def test_speed_keys_change_by_ten_per_cent_and_keep_the_direction(key: str, speed: float, turn: float) -> None:
    teleop = KeyboardTeleop(speed=1.0, turn=1.0)
    teleop.press("u", now=0.0)
    assert teleop.press(key, now=0.0)
    assert teleop.velocity(now=0.0) == BaseVelocity(pytest.approx(speed), 0, pytest.approx(turn))


def test_speeds_stay_below_their_limits() -> None:
    teleop = KeyboardTeleop(speed=1.0, turn=1.0, speed_limit=1.05, turn_limit=2.0)
    teleop.press("q", now=0.0)
    assert (teleop.speed, teleop.turn) == (1.05, pytest.approx(1.1))
    assert not teleop.press("w", now=0.0)
