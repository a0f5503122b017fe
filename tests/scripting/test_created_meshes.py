# SPDX-License-Identifier: BSD-3-Clause
"""Shapes of triangles, groups and scaling of created shapes, in a simulation."""

from pathlib import Path

import pytest

from node_support import REFUSED, in_init, run_script

CUBE = """
signs = [[i & 1, i >> 1 & 1, i >> 2 & 1] for i in range(8)]
quads = [(0, 2, 3, 1), (4, 5, 7, 6), (0, 1, 5, 4), (2, 6, 7, 3), (0, 4, 6, 2), (1, 3, 7, 5)]
def cube(size, x, y, z):
    vertices = [size * (part - 0.5) + place for corner in signs for part, place in zip(corner, (x, y, z))]
    return vertices, [n for a, b, c, d in quads for n in (a, b, c, a, c, d)]
near = lambda a, b, tol=1e-6: all(abs(x - y) <= tol for x, y in zip(a, b, strict=True))
"""


def check(folder: Path, code: str, until: float = 0.2, scene: str = "p3dx_floor", target: str = "/PioneerP3DX") -> str:
    run = run_script(folder, CUBE + REFUSED + code, "--strict", scene=scene, target=target, until=until)
    assert (run.stderr, run.returncode) == ("", 0)
    return run.stdout


def test_a_shape_of_triangles_has_its_place_and_size(tmp_path: Path) -> None:
    body = """
shape = sim.createShape(0, 0.5, *cube(0.2, 1, 2, 3))
assert sim.getObjectType(shape) == sim.object_shape_type
assert near(sim.getObjectPosition(shape), [1, 2, 3]) and near(sim.getShapeBB(shape), [0.2] * 3, 1e-4)
assert abs(sim.getShapeMass(shape) - 8) < 1e-3
assert sim.getShapeGeomInfo(shape)[:2] == (0, sim.primitiveshape_none)
vertices, indices, normals = sim.getShapeMesh(shape)
assert (len(vertices), len(indices), len(normals)) == (24, 36, 108)
assert sim.getShapeViz(shape, 0)['indices'] == indices and sim.getShapeViz(shape, 1) is None
assert '0 to 7' in refused(sim.createShape, 0, 0.5, cube(0.2, 0, 0, 0)[0], [0, 1, 9])
"""
    check(tmp_path, in_init(body))


def test_a_cube_of_triangles_falls_onto_the_floor(tmp_path: Path) -> None:
    code = """
def sysCall_init():
    self.cube = sim.createShape(0, 0.5, *cube(0.2, 2, 0, 0.3))
    sim.setObjectInt32Param(self.cube, sim.shapeintparam_static, 0)
    sim.setObjectInt32Param(self.cube, sim.shapeintparam_respondable, 1)
def sysCall_cleanup():
    print(sim.getObjectPosition(self.cube)[2])
"""
    assert float(check(tmp_path, code, until=2.0)) == pytest.approx(0.1, abs=2e-3)


def test_a_surface_has_the_heights_of_its_points(tmp_path: Path) -> None:
    body = """
surface = sim.createHeightfieldShape(0, 0.5, 3, 2, 2.0, [0, 0, 0, 0, 0.5, 0])
assert near(sim.getShapeBB(surface), [2, 1, 0.5], 1e-4)
assert 'found 5' in refused(sim.createHeightfieldShape, 0, 0, 3, 2, 2.0, [0] * 5)
"""
    check(tmp_path, in_init(body))


def test_shapes_are_grouped_to_one_body_and_ungrouped(tmp_path: Path) -> None:
    body = """
parts = [sim.createPrimitiveShape(sim.primitiveshape_cuboid, [0.1, 0.1, 0.1]) for _ in range(2)]
sim.setObjectPosition(parts[1], [1, 0, 0])
sim.setObjectColor(parts[1], 0, 0, [1, 0, 0])
mass = sum(sim.getShapeMass(part) for part in parts)
group = sim.groupShapes(parts)
assert not sim.isHandle(parts[1]) and abs(sim.getShapeMass(group) - mass) < 1e-9
assert near(sim.getShapeBB(group), [1.1, 0.1, 0.1]) and near(sim.getObjectPosition(group), [0.5, 0, 0])
assert sim.getShapeGeomInfo(group)[0] == 1
sim.setObjectPosition(group, [0.5, 2, 0])
first, second = sim.ungroupShape(group)
assert near(sim.getObjectPosition(second), [1, 2, 0]) and near(sim.getObjectColor(second, 0, 0), [1, 0, 0])
assert sim.ungroupShape(first) == [first]
"""
    check(tmp_path, in_init(body))


def test_created_shapes_are_scaled_with_their_masses(tmp_path: Path) -> None:
    body = """
box = sim.createPrimitiveShape(sim.primitiveshape_cuboid, [0.1, 0.2, 0.3])
mass = sim.getShapeMass(box)
sim.scaleObjects([box], 2.0, False)
assert near(sim.getShapeBB(box), [0.2, 0.4, 0.6]) and abs(sim.getShapeMass(box) - 8 * mass) < 1e-9
sim.scaleObject(box, 1, 1, 0.5)
assert near(sim.getShapeBB(box), [0.2, 0.4, 0.3])
sim.setShapeBB(box, [1, 1, 1])
assert near(sim.getShapeBB(box), [1, 1, 1])
one, two = sim.createDummy(0.1), sim.createDummy(0.1)
sim.setObjectPosition(two, [1, 0, 0])
sim.scaleObjects([one, two], 3.0, True)
assert near(sim.getObjectPosition(two), [3, 0, 0]) and abs(sim.getDummySize(two) - 0.3) < 1e-9
"""
    check(tmp_path, in_init(body))


def test_shapes_of_the_file_keep_their_size_with_a_warning(tmp_path: Path) -> None:
    code = "def sysCall_init():\n    sim.scaleObjects([sim.getObject('.')], 2.0)\n"
    run = run_script(tmp_path, code, "--strict")
    assert run.returncode == 0
    assert "keeps its size" in run.stderr


def test_octrees_hold_voxels(tmp_path: Path) -> None:
    body = """
tree = sim.createOctree(0.1)
assert sim.insertVoxelsIntoOctree(tree, 0, [0.05, 0.05, 0.05, 0.06, 0.04, 0.05, 0.15, 0.05, 0.05]) == 2
assert near(sim.getOctreeVoxels(tree), [0.05, 0.05, 0.05, 0.15, 0.05, 0.05])
assert sim.checkOctreePointOccupancy(tree, 0, [0.01, 0.01, 0.01])[0] == 1
assert sim.checkOctreePointOccupancy(tree, 0, [0.01, 0.01, 0.51])[0] == 0
sim.setObjectPosition(tree, [1, 0, 0])
assert sim.checkOctreePointOccupancy(tree, 0, [1.01, 0.01, 0.01])[0] == 1
assert sim.removeVoxelsFromOctree(tree, 1, [0.05, 0.05, 0.05]) == 1 and sim.removeVoxelsFromOctree(tree, 0) == 0
"""
    check(tmp_path, in_init(body))


def test_a_mesh_file_is_a_shape_or_its_triangles(tmp_path: Path) -> None:
    file = tmp_path / "corner.obj"
    file.write_text("v 0 0 0\nv 1 0 0\nv 0 2 0\nv 0 0 3\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n")
    body = f"""
vertices, indices = sim.importMesh(0, '{file}')
assert sorted(vertices[0][i : i + 3] for i in range(0, len(vertices[0]), 3))[-1] == [1, 0, 0] and len(indices[0]) == 12
assert near(sim.getShapeBB(sim.importShape(0, '{file}', 0, 0, 0.5)), [0.5, 1, 1.5], 1e-4)
"""
    check(tmp_path, in_init(body))
