# SPDX-License-Identifier: BSD-3-Clause
"""Maps from scans at known poses."""

import math

from bubblesim.controllers.planar_motion import Pose2D
from bubblesim.navigation.scan_map import ScanMap


def occupied(scans: ScanMap) -> set[tuple[float, float]]:
    """Return the centres of the occupied cells."""
    rows, columns = scans.grid.occupied.nonzero()
    centres = [scans.grid.centre_of((int(row), int(column))) for row, column in zip(rows, columns, strict=True)]
    return {(round(x, 2), round(y, 2)) for x, y in centres}


def test_a_hit_is_marked_where_the_robot_sees_it() -> None:
    scans = ScanMap(0.1, corner=(-2.0, -2.0), size=(4.0, 4.0))
    scans.add(Pose2D(1.0, 0.05, math.pi / 2), [(1.0, 0.5)])  # ahead is +y, left is -x
    assert occupied(scans) == {(0.55, 1.05)}


def test_a_ray_that_passes_clears_what_is_gone() -> None:
    scans = ScanMap(0.1, corner=(-2.0, -2.0), size=(4.0, 4.0))
    scans.add(Pose2D(-1.45, 0.05, 0.0), [(1.0, 0.0)])
    scans.add(Pose2D(-1.45, 0.05, 0.0), [(2.0, 0.0)])
    assert occupied(scans) == {(0.55, 0.05)}


def test_hits_beyond_the_map_and_empty_scans_change_nothing() -> None:
    scans = ScanMap(0.1, corner=(-2.0, -2.0), size=(4.0, 4.0))
    grid = scans.grid
    scans.add(Pose2D(0.0, 0.0, 0.0), [])
    assert scans.grid is grid
    scans.add(Pose2D(0.0, 0.0, 0.0), [(9.0, 0.0), (0.0, -9.0)])
    assert occupied(scans) == set()
