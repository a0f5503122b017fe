# SPDX-License-Identifier: BSD-3-Clause
"""Outlines of shapes seen from above."""

import math
from types import SimpleNamespace

import numpy as np
import pytest

from bubblesim.running.picture import convex_hull, moved, outline
from bubblesim.running.recording import Pose

UPRIGHT = (0.0, 0.0, 0.0, 1.0)
ON_ITS_SIDE = (math.sqrt(0.5), 0.0, 0.0, math.sqrt(0.5))  # a quarter turn about x: the axis lies along -y


def shape(kind: str, size: tuple[float, ...], orientation: tuple[float, ...] = UPRIGHT) -> SimpleNamespace:
    return SimpleNamespace(kind=kind, size=size, position=np.array([1.0, 2.0, 3.0]), orientation=orientation)


def extent(points: np.ndarray) -> list[float]:
    return [float(side) for side in np.ptp(points, axis=0)]


def test_hull_leaves_out_what_is_inside() -> None:
    square = np.array([[0.0, 0.0], [1.0, 0.0], [0.5, 0.5], [1.0, 1.0], [0.0, 1.0]])
    assert sorted(convex_hull(square).tolist()) == [[0.0, 0.0], [0.0, 1.0], [1.0, 0.0], [1.0, 1.0]]


def test_a_box_is_a_rectangle_of_its_sides() -> None:
    assert extent(outline(shape("box", (2.0, 4.0, 6.0)))) == pytest.approx([2.0, 4.0])


def test_a_box_turned_by_45_degrees_is_wider() -> None:
    turned = (0.0, 0.0, math.sin(math.pi / 8), math.cos(math.pi / 8))
    assert extent(outline(shape("box", (1.0, 1.0, 1.0), turned))) == pytest.approx([math.sqrt(2.0)] * 2)


def test_a_standing_cylinder_is_round() -> None:
    assert extent(outline(shape("cylinder", (0.5, 3.0)))) == pytest.approx([1.0, 1.0], rel=0.01)


def test_a_lying_cylinder_is_as_long_as_it_is() -> None:
    assert extent(outline(shape("cylinder", (0.5, 3.0), ON_ITS_SIDE))) == pytest.approx([1.0, 3.0], rel=0.01)


def test_a_sphere_is_round_about_its_middle() -> None:
    points = outline(shape("sphere", (0.5,)))
    assert points.mean(axis=0) == pytest.approx([1.0, 2.0])
    assert extent(points) == pytest.approx([1.0, 1.0], rel=0.01)


def test_a_lying_capsule_has_its_round_ends() -> None:
    assert extent(outline(shape("capsule", (0.5, 3.0), ON_ITS_SIDE))) == pytest.approx([1.0, 4.0], rel=0.01)


def test_an_ellipsoid_is_as_wide_as_its_radii() -> None:
    assert extent(outline(shape("ellipsoid", (1.0, 2.0, 3.0)))) == pytest.approx([2.0, 4.0], rel=0.01)
    assert extent(outline(shape("ellipsoid", (1.0, 2.0, 3.0), ON_ITS_SIDE))) == pytest.approx([2.0, 6.0], rel=0.01)


def test_a_mesh_is_drawn_by_its_corners() -> None:
    mesh = shape("mesh", (1.0, 2.0, 0.0))
    mesh.vertices = np.array([[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 2.0, 0.0]])
    assert sorted(outline(mesh).tolist()) == [[1.0, 2.0], [1.0, 4.0], [2.0, 2.0]]


def test_points_move_with_their_body() -> None:
    start, end = Pose(1.0, 0.0, 0.0, 0.0), Pose(5.0, 5.0, 0.0, math.pi / 2.0)
    assert moved(np.array([[2.0, 0.0]]), start, end)[0] == pytest.approx([5.0, 6.0])
