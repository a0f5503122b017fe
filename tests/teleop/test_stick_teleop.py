# SPDX-License-Identifier: BSD-3-Clause
import math

import pytest

from bubblesim.controllers.base_velocity import STANDING, BaseVelocity
from bubblesim.teleop.joystick import EVENT, Joystick
from bubblesim.teleop.stick_teleop import StickTeleop

AXIS, BUTTON, INITIAL = 2, 1, 0x80


@pytest.mark.parametrize(
    ("forward", "left", "expected"),
    [
        (0.0, 0.0, STANDING),
        (0.2, -0.2, STANDING),  # in the dead zone
        (1.0, 0.0, BaseVelocity(forward=2.0)),
        (-1.0, 1.0, BaseVelocity(forward=-2.0, turning=3.0)),
        (0.6, -0.6, BaseVelocity(forward=1.0, turning=-1.5)),  # half of the range outside the dead zone
        (9.0, -9.0, BaseVelocity(forward=2.0, turning=-3.0)),
    ],
)
def test_a_stick_means_a_velocity(forward: float, left: float, expected: BaseVelocity) -> None:
    velocity = StickTeleop(speed=2.0, turn=3.0, dead_zone=0.2).velocity(forward, left)
    assert (velocity.forward, velocity.turning) == pytest.approx((expected.forward, expected.turning))


@pytest.mark.parametrize("values", [{"speed": math.inf}, {"turn": math.nan}, {"dead_zone": 1.0}, {"dead_zone": -0.1}])
def test_a_stick_that_cannot_be_is_refused(values: dict[str, float]) -> None:
    with pytest.raises(ValueError, match="dead_zone"):
        StickTeleop(**values)


def test_events_set_axes_and_buttons() -> None:
    joystick = Joystick()
    joystick.feed(EVENT.pack(1, -32768, AXIS, 1) + EVENT.pack(2, 16384, AXIS | INITIAL, 0))
    joystick.feed(EVENT.pack(3, 1, BUTTON, 5) + EVENT.pack(4, 7, 0x40, 9))  # the last is of an unknown kind
    assert joystick.axes == pytest.approx({1: -1.0, 0: 0.5}, abs=1e-4)
    assert joystick.buttons == {5: True}
    joystick.feed(EVENT.pack(5, 0, BUTTON, 5))
    assert joystick.buttons == {5: False}


def test_events_may_come_in_pieces() -> None:
    joystick = Joystick()
    for byte in EVENT.pack(1, 32767, AXIS, 3) * 2:
        joystick.feed(bytes([byte]))
    assert joystick.axes == {3: 1.0}
