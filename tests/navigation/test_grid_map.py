# SPDX-License-Identifier: BSD-3-Clause
import math
from types import SimpleNamespace

import numpy as np
import pytest

from bubblesim.navigation.grid_map import GridMap
from rooms import drawn


def test_cells_and_points_fit_together_in_a_turned_map() -> None:
    grid = drawn("    \n    ", origin=(1.0, 2.0, math.pi / 2))
    # The map's x axis points along y: column 2 is 1.25 m up, row 1 is 0.75 m to the left.
    assert grid.centre_of((1, 2)) == pytest.approx((0.25, 3.25))
    assert grid.cell_of((0.25, 3.25)) == (1, 2)


def test_points_outside_are_in_none_of_the_maps_cells() -> None:
    grid = drawn("  \n  ")
    assert [grid.has(grid.cell_of(point)) for point in [(0.1, 0.1), (-0.1, 0.1), (0.1, 1.1)]] == [True, False, False]


def test_clearance_is_the_distance_to_the_nearest_wall() -> None:
    clearance = drawn("#      ").clearance()
    assert clearance[0] == pytest.approx([0, 0.5, 1, 1.5, 2, 2.5, 3], rel=0.02)
    assert np.isinf(drawn("   ").clearance()).all()


def test_obstacles_become_walls_and_the_map_itself_stays() -> None:
    grid = drawn("   ")
    assert grid.with_obstacles([(0.6, 0.1), (9.0, 9.0)]).occupied.tolist() == [[False, True, False]]
    assert not grid.occupied.any()


def test_a_message_becomes_a_map() -> None:
    origin = SimpleNamespace(
        position=SimpleNamespace(x=1.0, y=2.0),
        orientation=SimpleNamespace(x=0.0, y=0.0, z=math.sin(0.1), w=math.cos(0.1)),
    )
    info = SimpleNamespace(width=3, height=2, resolution=0.25, origin=origin)
    grid = GridMap.from_message(SimpleNamespace(info=info, data=[0, 50, 100, -1, 25, 65]))
    assert grid.cells.tolist() == [[0, 50, 100], [-1, 25, 65]]
    assert grid.origin == pytest.approx((1.0, 2.0, 0.2))
    assert grid.free.tolist() == [[True, False, False], [False, True, False]]
    assert grid.occupied.tolist() == [[False, False, True], [False, False, True]]
