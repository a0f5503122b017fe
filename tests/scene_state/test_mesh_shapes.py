# SPDX-License-Identifier: BSD-3-Clause
"""Masses and files of meshes, groups and mesh files, against closed forms."""

from pathlib import Path

import numpy as np
import pytest

from bubblesim.scene_state.compound_shapes import CompoundShape, Member
from bubblesim.scene_state.mesh_files import read_mesh
from bubblesim.scene_state.mesh_shapes import MeshShape, centred
from bubblesim.scene_state.primitive_shapes import CUBOID, PrimitiveShape

SIGNS = np.array([[i & 1, i >> 1 & 1, i >> 2 & 1] for i in range(8)]) - 0.5
QUADS = [(0, 2, 3, 1), (4, 5, 7, 6), (0, 1, 5, 4), (2, 6, 7, 3), (0, 4, 6, 2), (1, 3, 7, 5)]
TRIANGLES = np.array([corner for a, b, c, d in QUADS for corner in ((a, b, c), (a, c, d))])


def test_a_cuboid_of_triangles_has_mass_and_inertia_of_a_cuboid() -> None:
    x, y, z = 0.2, 0.4, 0.6
    shape, centre = centred(SIGNS * [x, y, z] + [1, 2, 3], TRIANGLES)
    assert centre == pytest.approx([1, 2, 3])
    assert shape.mass == pytest.approx(1000 * x * y * z)  # of water
    expected = shape.mass / 12 * np.array([y * y + z * z, x * x + z * z, x * x + y * y])
    np.testing.assert_allclose(shape.part().inertia, np.diag(expected), atol=1e-9)


def test_the_centre_of_mass_of_a_pyramid_is_at_a_quarter_of_its_height() -> None:
    vertices = np.array([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0], [0.5, 0.5, 1]], float)
    triangles = np.array([[0, 2, 1], [0, 3, 2], [0, 1, 4], [1, 2, 4], [2, 3, 4], [3, 0, 4]])
    shape = MeshShape(vertices, triangles)
    assert shape.mass == pytest.approx(1000 / 3)
    np.testing.assert_allclose(shape.part().centre, [0.5, 0.5, 0.25])


@pytest.mark.parametrize(
    ("vertices", "triangles", "why"),
    [
        (SIGNS, np.zeros((0, 3), int), "1 to 1000000 triangles"),
        (SIGNS, np.array([[0, 1, 8]]), "0 to 7"),
        (SIGNS * np.nan, TRIANGLES, "must be finite"),
    ],
)
def test_meshes_that_are_none_are_refused(vertices: np.ndarray, triangles: np.ndarray, why: str) -> None:
    with pytest.raises(ValueError, match=why):
        MeshShape(vertices, triangles)


def test_the_inertia_of_a_group_is_that_of_its_members_by_steiners_theorem() -> None:
    cube = PrimitiveShape(CUBOID, [0.1, 0.1, 0.1], 2.0)
    members = [Member(cube, [0, 0, z, 0, 0, 0, 1], [1, 0, 0]) for z in (-0.5, 0.5)]
    text = CompoundShape(members).sdf()
    own = 2.0 / 12 * 2 * 0.1**2
    assert f"<ixx>{2 * (own + 2.0 * 0.5**2):.6f}"[:12] in text
    assert "<mass>4.0</mass>" in text
    assert text.count("<collision ") == text.count("<visual ") == 2


def test_mesh_files_are_read(tmp_path: Path) -> None:
    shape = MeshShape(SIGNS * 2, TRIANGLES)
    shape.part()
    assert shape.file is not None
    vertices, triangles = read_mesh(shape.file)
    assert (len(vertices), len(triangles)) == (8, 12)
    assert MeshShape(vertices, triangles).mass == pytest.approx(8000)
    obj = tmp_path / "cube.obj"
    lines = [f"v {x} {y} {z}" for x, y, z in SIGNS]
    obj.write_text("\n".join([*lines, *("f " + " ".join(f"{c + 1}/1" for c in quad) for quad in QUADS)]))
    vertices, triangles = read_mesh(obj)
    assert MeshShape(vertices, triangles).mass == pytest.approx(1000)
    obj.write_text("v 1 2\nf 1 1 1")
    with pytest.raises(ValueError, match="three numbers"):
        read_mesh(obj)
    with pytest.raises(ValueError, match=r"\.obj or \.stl"):
        read_mesh(tmp_path / "a.dae")
