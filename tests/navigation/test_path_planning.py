# SPDX-License-Identifier: BSD-3-Clause
import math
from itertools import pairwise

import numpy as np
import pytest

from bubblesim.navigation.grid_map import GridMap
from bubblesim.navigation.path_planning import Footprint, NoPathError, is_clear, passable, plan
from rooms import drawn

SLIM = Footprint(radius=0.1, comfort=0.1)
U_SHAPE = """
#########
#       #
#  ###  #
#    #  #
#    #  #
#########
"""


def length(path: list[tuple[float, float]]) -> float:
    return sum(math.dist(*pair) for pair in pairwise(path))


def test_the_way_through_the_open_is_straight() -> None:
    path = plan(drawn("          \n" * 10), (0.25, 0.25), (4.25, 4.25), SLIM)
    assert (path[0], path[-1]) == ((0.25, 0.25), (4.25, 4.25))
    assert length(path) == pytest.approx(4 * math.sqrt(2))


def test_the_way_round_a_wall_is_as_short_as_it_can_be() -> None:
    grid = drawn(U_SHAPE)
    path = plan(grid, (2.25, 0.75), (3.25, 0.75), SLIM)
    assert not any(grid.occupied[grid.cell_of(point)] for point in path)
    # By hand, in steps of half a metre: 2 diagonal and 1 straight to (1.25, 2.25), 1 diagonal past the corner,
    # 3 across, 1 diagonal, 3 down.
    assert length(path) == pytest.approx(0.5 * (4 * math.sqrt(2) + 6), abs=1.0)


def test_a_stout_robot_takes_no_narrow_gap() -> None:
    gap = drawn("#######\n   #   \n       \n   #   \n#######")
    assert plan(gap, (0.25, 1.25), (3.25, 1.25), SLIM)
    with pytest.raises(NoPathError, match="walls"):
        plan(gap, (0.25, 1.25), (3.25, 1.25), Footprint(radius=0.6, comfort=0.6))


def test_it_keeps_off_the_walls_where_there_is_room() -> None:
    corridor = drawn("#" * 20 + "\n" + (" " * 20 + "\n") * 7 + "#" * 20, resolution=0.2)
    path = plan(corridor, (0.3, 0.3), (3.7, 0.3), Footprint(radius=0.1, comfort=0.7))
    assert max(y for _, y in path) > 0.6


def test_a_robot_that_stands_too_close_to_a_wall_can_leave() -> None:
    grid = drawn("          \n" * 4 + "##########", resolution=0.1)
    path = plan(grid, (0.25, 0.15), (0.75, 0.45), Footprint(radius=0.2, comfort=0.2))
    assert path[-1] == (0.75, 0.45)


@pytest.mark.parametrize(
    ("start", "goal", "why"),
    [
        ((9.0, 9.0), (0.25, 0.25), "the robot is outside"),
        ((0.25, 0.25), (-1.0, 0.25), "the goal is outside"),
        ((0.25, 0.25), (1.25, 0.25), "not on a free cell"),
        ((0.25, 0.25), (1.75, 0.25), "not on a free cell"),
        ((0.25, 0.25), (0.75, 1.25), "walls"),
    ],
)
def test_why_there_is_no_path_is_reported(start: tuple[float, float], goal: tuple[float, float], why: str) -> None:
    with pytest.raises(NoPathError, match=why):
        plan(drawn("#  #\n####\n  #?"), start, goal, SLIM)


def shortest(free: np.ndarray, first: tuple[int, int], last: tuple[int, int]) -> float:
    """Relax all cells until nothing changes (Bellman 1958); return the length in cells, inf without a path."""
    rows, columns = free.shape
    reached = np.full((rows + 2, columns + 2), math.inf)
    reached[first[0] + 1, first[1] + 1] = 0.0
    while True:
        before = reached.copy()
        for dr, dc in [(dr, dc) for dr in (-1, 0, 1) for dc in (-1, 0, 1) if (dr, dc) != (0, 0)]:
            beside = before[1 + dr : rows + 1 + dr, 1 + dc : columns + 1 + dc] + math.hypot(dr, dc)
            middle = reached[1:-1, 1:-1]
            np.copyto(middle, np.minimum(middle, beside), where=free)
        if np.array_equal(reached, before):
            return float(reached[last[0] + 1, last[1] + 1])


@pytest.mark.parametrize("seed", range(20))
def test_paths_are_as_short_as_by_another_method(seed: int) -> None:
    random = np.random.default_rng(seed)
    cells = np.where(random.random((15, 15)) < 0.3, 100, 0).astype(np.int8)
    cells[0, 0] = cells[14, 14] = 0
    grid = GridMap(cells, 1.0)
    expected = shortest(cells == 0, (0, 0), (14, 14))
    if math.isinf(expected):
        with pytest.raises(NoPathError):
            plan(grid, (0.5, 0.5), (14.5, 14.5), SLIM)
    else:
        assert length(plan(grid, (0.5, 0.5), (14.5, 14.5), SLIM)) == pytest.approx(expected)


@pytest.mark.parametrize("heading", [0.0, 0.7])
def test_a_path_is_clear_where_the_robot_can_be_on_all_of_the_map(heading: float) -> None:
    random = np.random.default_rng(1)
    found = []
    for _ in range(200):
        cells = np.where(random.random((30, 40)) < 0.02, 100, 0).astype(np.int8)
        grid = GridMap(cells, 0.1, (-1.0, 2.0, heading))
        footprint = Footprint(float(random.uniform(0.1, 0.5)), 0.5)
        path = [grid.centre_of((int(row), int(column))) for row, column in random.integers(-1, 31, (3, 2))]
        may_pass = passable(grid, footprint)
        expected = all(grid.has(cell) and may_pass[cell] for cell in map(grid.cell_of, path))
        assert is_clear(grid, path, footprint) == expected
        found.append(expected)
    assert 20 < sum(found) < 180
    assert is_clear(grid, [], footprint)
