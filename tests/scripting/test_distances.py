# SPDX-License-Identifier: BSD-3-Clause
"""Distances, collisions and sizes of shapes, against geometry."""

from pathlib import Path

from node_support import in_init, run_script

HEADER = "import math\nimport numpy as np\nnear = lambda a, b: np.testing.assert_allclose(a, b, atol=1e-6)\n"


def check(folder: Path, body: str, target: str = "/Ball") -> str:
    run = run_script(folder, HEADER + in_init(body), "--strict", target=target, until=0.05)
    assert run.stderr == ""
    assert run.returncode == 0
    return run.stdout


def test_distances_of_plain_shapes(tmp_path: Path) -> None:
    body = """
a = sim.createPureShape(0, 8 + 16, [1, 1, 1], 1)
b = sim.createPureShape(1, 8 + 16, [0.4, 0.4, 0.4], 1)
sim.setObjectPosition(a, [10, 10, 5])
sim.setObjectPosition(b, [12, 10, 5])
found, numbers, handles = sim.checkDistance(a, b)
assert found == 1 and handles == [a, b]
near(numbers, [10.5, 10, 5, 11.8, 10, 5, 1.3])
sim.setObjectOrientation(a, [0, 0, math.pi / 4])  # an edge faces the ball
near(sim.checkDistance(a, b)[1][6], 2 - math.sqrt(0.5) - 0.2)
assert sim.checkDistance(a, b, 1.0) == (0, [], [])  # beyond the threshold
assert sim.checkDistance(a, b, 1.1)[0] == 1
assert sim.checkCollision(a, b) == (0, [])
sim.setObjectPosition(b, [10.8, 10, 5])
assert sim.checkCollision(a, b) == (1, [a, b])
near(sim.checkDistance(a, b)[1][6], 0)
"""
    check(tmp_path, body)


def test_distances_to_a_plane_collections_and_all(tmp_path: Path) -> None:
    body = """
a = sim.createPureShape(2, 8 + 16, [0.2, 0.2, 1], 1)  # a cylinder
sim.setObjectPosition(a, [20, 20, 3])
near(sim.checkDistance(a, sim.getObject('/Floor'))[1][6], 2.5)
near(sim.checkDistance(a, sim.handle_all)[1][6], 2.5)
b, c = (sim.createPureShape(0, 8 + 16, [1, 1, 1], 1) for _ in range(2))
sim.setObjectPosition(b, [22, 20, 3])
sim.setObjectPosition(c, [18.5, 20, 3])
both = sim.createCollection(0)
for each in (b, c):
    sim.addItemToCollection(both, sim.handle_single, each, 0)
found, numbers, handles = sim.checkDistance(a, both)
near(numbers[6], 0.9)
assert handles == [a, c]
sim.setObjectSpecialProperty(c, 0)  # neither measurable nor collidable
assert sim.checkDistance(a, both)[2] == [a, b]
sim.setObjectPosition(c, [20, 20, 3])
assert sim.checkCollision(a, both)[0] == 0
"""
    check(tmp_path, body)


def test_a_shape_that_is_not_respondable_collides_in_checks_alone(tmp_path: Path) -> None:
    code = """
        def sysCall_init():
            self.box = sim.createPrimitiveShape(sim.primitiveshape_cuboid, [4, 4, 0.2])
            sim.setObjectPosition(self.box, sim.getObjectPosition(sim.getObject('.')))
            assert sim.checkCollision(self.box, sim.getObject('.'))[0] == 1
            self.z = sim.getObjectPosition(sim.getObject('.'))[2]
        def sysCall_cleanup():
            assert sim.getObjectPosition(sim.getObject('.'))[2] < self.z - 0.02  # the ball falls through it
    """
    run = run_script(tmp_path, code, "--strict", until=0.2)
    assert (run.returncode, run.stderr) == (0, "")


def test_sizes_of_shapes(tmp_path: Path) -> None:
    body = """
a = sim.createPureShape(0, 8, [1, 2, 3], 6)
sim.setObjectOrientation(a, [0.3, 0.2, 0.1])
near(sim.getShapeBB(a), [1, 2, 3])  # along its own axes
assert sim.getShapeGeomInfo(a) == (2, sim.primitiveshape_cuboid, [1, 2, 3, 0])
mass, inertia, centre = sim.getShapeMassAndInertia(a)
near([mass, *inertia[::4], *centre], [6, 6 / 12 * 13, 6 / 12 * 10, 6 / 12 * 5, 0, 0, 0])
assert sim.computeMassAndInertia(a, 500) == 1
near(sim.getShapeMass(a), 3000)
near(sim.getShapeBB(sim.getObject('.')), [0.2, 0.2, 0.2])
"""
    check(tmp_path, body)


def test_a_place_where_two_shapes_overlap_is_found(tmp_path: Path) -> None:
    body = """
a = sim.createPureShape(0, 8 + 16, [1, 1, 1], 1)
b = sim.createPureShape(0, 8 + 16, [1, 1, 1], 1)
sim.setObjectPosition(a, [10, 10, 5])
sim.setObjectPosition(b, [10.8, 10, 5])
result, segment = sim.checkCollisionEx(a, b)
assert result == 1 and len(segment) == 6
assert all(9.5 - 1e-6 <= x <= 11.3 + 1e-6 for x in segment[::3])
sim.setObjectPosition(b, [12, 10, 5])
assert sim.checkCollisionEx(a, b)[0] == 0
made = sim.createCollection(0)
assert sim.emptyCollection(made) is not None
"""
    check(tmp_path, body)
