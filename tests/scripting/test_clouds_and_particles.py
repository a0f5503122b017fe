# SPDX-License-Identifier: BSD-3-Clause
"""Point clouds, octrees and particles of scripts, which are drawn."""

from pathlib import Path

from node_support import in_init, run_script

HEADER = "import numpy as np\nnear = lambda a, b: np.testing.assert_allclose(a, b, atol=1e-6)\n"


def check(folder: Path, body: str, rest: str = "", until: float = 0.1) -> None:
    code = HEADER + in_init(body) + rest
    run = run_script(folder, code, "--strict", scene="tricycle", target="/Tricycle", until=until)
    assert (run.stderr, run.returncode) == ("", 0)


def test_points_are_inserted_intersected_and_removed(tmp_path: Path) -> None:
    body = """
cloud = sim.createPointCloud(0.02, 20, 0, 2)
assert sim.insertPointsIntoPointCloud(cloud, 0, [0, 0, 0, 1, 0, 0, 2, 0, 0]) == 3
near(sim.getPointCloudPoints(cloud), [0, 0, 0, 1, 0, 0, 2, 0, 0])
assert sim.removePointsFromPointCloud(cloud, 0, [1, 0, 0], 0.1) == 2
assert sim.intersectPointsWithPointCloud(cloud, 0, [2, 0, 0.05], 0.1) == 1
near(sim.getPointCloudPoints(cloud), [2, 0, 0])
assert sim.removePointsFromPointCloud(cloud, 0, None, 0) == 0
box = sim.createPrimitiveShape(sim.primitiveshape_cuboid, [0.2, 0.4, 0.6])
assert sim.insertObjectIntoPointCloud(cloud, box, 0, 0.02) == 8
near(sorted(set(np.round(np.abs(sim.getPointCloudPoints(cloud)), 6))), [0.1, 0.2, 0.3])
assert sim.subtractObjectFromPointCloud(cloud, box) == 8
assert len(sim.getPointCloudOptions(cloud)) == 4 and sim.setPointCloudOptions(cloud, 0.1, 1, 0, 1) == 1
"""
    check(tmp_path, body)


def test_an_octree_takes_the_voxels_of_an_object(tmp_path: Path) -> None:
    body = """
octree = sim.createOctree(0.1)
box = sim.createPrimitiveShape(sim.primitiveshape_cuboid, [0.38, 0.18, 0.18])
sim.setObjectPosition(box, [0.2, 0.1, 0.1])
count = sim.insertObjectIntoOctree(octree, box)
assert count == 4 * 2 * 2
assert sim.checkOctreePointOccupancy(octree, 0, [0.35, 0.15, 0.15])[0] == 1
assert sim.subtractObjectFromOctree(octree, box) == count
"""
    check(tmp_path, body)


def test_particles_are_added_and_removed(tmp_path: Path) -> None:
    body = """
self.falling = sim.addParticleObject(sim.particle_spheres, 0.02, 1000, None, 0.2, 10)
assert sim.addParticleObjectItem(self.falling, [0, 0, 5, 0, 0, 0]) == 1
"""
    rest = """
def sysCall_cleanup():
    assert sim.addParticleObjectItem(self.falling, None) == 1
    assert sim.removeParticleObject(self.falling) == 1
    try:
        sim.addParticleObjectItem(self.falling, [0, 0, 5, 0, 0, 0])
    except LookupError as error:
        assert 'no particles' in str(error)
    else:
        raise AssertionError('accepted')
"""
    check(tmp_path, body, rest, until=0.4)
