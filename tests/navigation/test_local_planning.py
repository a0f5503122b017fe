# SPDX-License-Identifier: BSD-3-Clause
"""Local planning: the clearance of a body, arcs between obstacles, speeds."""

import math

import numpy as np
import pytest

from bubblesim.navigation.driver import Driver
from bubblesim.navigation.local_planning import (
    Arc,
    Body,
    DistanceField,
    best_arc,
    can_turn,
    carrot,
    clearance,
    speed_on,
)

BODY = Body.rectangle(length=0.5, width=0.4)
DRIVER = Driver(max_speed=1.0, max_turn=2.0, acceleration=1.0)
NONE = np.empty((0, 2))


def wall(x: float, gap: tuple[float, float]) -> np.ndarray:
    """Return points of a wall across the way with a gap between two y."""
    return np.array([(x, y) for y in np.arange(-1.5, 1.5, 0.02) if not gap[0] < y < gap[1]])


def test_discs_cover_a_rectangle() -> None:
    xs, ys = np.meshgrid(np.linspace(-0.25, 0.25, 21), np.linspace(-0.2, 0.2, 21))
    away = np.min([np.hypot(xs - centre, ys) for centre in BODY.centres], axis=0)
    assert (away <= BODY.radius + 1e-9).all()
    assert BODY.radius < 0.25  # a single disc would need 0.32 m


@pytest.mark.parametrize("angle", [0.0, 0.7, 2.0, -1.2])
def test_clearance_is_the_distance_to_the_discs(angle: float) -> None:
    point = (0.8 * math.cos(angle), 0.8 * math.sin(angle))
    field = DistanceField.around(np.array([point]), 1.2)
    zero = np.zeros(1)
    expected = min(math.dist((centre, 0.0), point) for centre in BODY.centres) - BODY.radius
    assert clearance(field, BODY, zero, zero, zero)[0] == pytest.approx(expected, abs=0.03)


def test_without_obstacles_the_arc_leads_to_the_target() -> None:
    field = DistanceField.around(NONE, 1.5)
    arc = best_arc((math.sin(0.8), 1 - math.cos(0.8)), field, BODY, DRIVER, 0.0)  # on the circle of radius 1
    assert arc is not None
    assert arc.curvature == pytest.approx(1.0, abs=0.15)
    assert arc.miss < 0.05


def test_the_arc_goes_through_a_gap_beside_the_way() -> None:
    field = DistanceField.around(wall(0.9, gap=(0.0, 0.9)), 1.8)
    arc = best_arc((1.2, 0.45), field, BODY, DRIVER, 0.0)
    assert arc is not None
    assert arc.curvature > 0.1
    assert arc.free > 1.2


def test_an_arc_ends_before_a_wall() -> None:
    field = DistanceField.around(wall(0.8, gap=(9.0, 9.0)), 1.8)
    arc = best_arc((1.2, 0.0), field, BODY, DRIVER, 0.0)
    assert arc is not None
    assert arc.free <= 0.8 - 0.25
    slow, fast = speed_on(arc, DRIVER, 9.0), speed_on(Arc(0.0, 3.0, 1.0, 0.0), DRIVER, 9.0)
    assert slow < fast == DRIVER.max_speed


def test_speed_keeps_the_limits_of_turn_and_of_acceleration() -> None:
    for curvature in (-3.0, -0.5, 0.0, 1.0, 6.0):
        speed = speed_on(Arc(curvature, 3.0, 1.0, 0.0), DRIVER, 9.0)
        assert speed * abs(curvature) <= DRIVER.max_turn + 1e-9
        assert speed**2 * abs(curvature) <= DRIVER.acceleration + 1e-9
    assert speed_on(Arc(0.0, 3.0, 1.0, 0.0), DRIVER, 0.125) == pytest.approx(0.5)  # v^2 = 2 a s


def test_a_long_body_turns_only_where_its_corners_have_room() -> None:
    beside = np.array([(x, 0.28) for x in np.arange(-0.4, 0.4, 0.02)])
    assert not can_turn(DistanceField.around(beside, 1.2), BODY, 1.5)
    assert can_turn(DistanceField.around(np.add(beside, (0.0, 0.2)), 1.2), BODY, 1.5)


def test_the_point_ahead_is_at_the_distance_or_the_end() -> None:
    path = [(0.1 * i, 0.0) for i in range(21)]
    assert carrot(path, (0.5, 0.1), 0.5)[0] == pytest.approx((1.0, 0.0))
    point, remaining = carrot(path, (1.9, 0.0), 0.5)
    assert point == pytest.approx((2.0, 0.0))
    assert remaining == pytest.approx(0.1)
