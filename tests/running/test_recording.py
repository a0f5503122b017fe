# SPDX-License-Identifier: BSD-3-Clause
"""The figures that the demo draws from a recording."""

import math

import pytest

from bubblesim.geometry.rotations import heading_of
from bubblesim.running.recording import Pose, Recording, Sample


def recording(*points: tuple[float, float, float, float]) -> Recording:
    """Return samples of (wall time, simulated time, x, y)."""
    return Recording([Sample(wall, sim, Pose(x, y, 0.0, 0.0)) for wall, sim, x, y in points])


def test_distance_is_the_length_of_the_path() -> None:
    assert recording((0, 0, 0, 0), (1, 1, 3, 4), (2, 2, 0, 0)).distance() == pytest.approx(10.0)


def test_nothing_seen_is_no_distance() -> None:
    assert Recording().distance() == 0.0


def test_real_time_factor_is_simulated_per_wall_time() -> None:
    assert recording((10, 0, 0, 0), (14, 2, 0, 0)).real_time_factor() == pytest.approx(0.5)


def test_real_time_factor_looks_back_as_far_as_asked() -> None:
    assert recording((0, 0, 0, 0), (10, 1, 0, 0), (11, 3, 0, 0)).real_time_factor(window=2.0) == pytest.approx(2.0)


def test_summary_names_the_closest_echo() -> None:
    seen = recording((0, 0, 0, 0), (1, 1, 1, 0))
    for distance in (math.inf, 0.75, 2.0):
        seen.add_sonar(distance)
    assert "0.75 m" in seen.summary()


def test_summary_is_silent_about_a_sonar_that_is_not_there() -> None:
    assert "echo" not in recording((0, 0, 0, 0), (1, 1, 1, 0)).summary()


@pytest.mark.parametrize("angle", [0.0, 1.0, -2.5])
def test_heading_is_the_turn_about_the_vertical(angle: float) -> None:
    assert heading_of(0.0, 0.0, math.sin(angle / 2.0), math.cos(angle / 2.0)) == pytest.approx(angle)
