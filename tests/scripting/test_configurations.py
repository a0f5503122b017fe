# SPDX-License-Identifier: BSD-3-Clause
"""Configurations of objects, joints that follow others, handles and data that objects keep."""

from pathlib import Path

from node_support import REFUSED, in_init, run_script

NEAR = "near = lambda a, b, tol=1e-9: all(abs(x - y) <= tol for x, y in zip(a, b, strict=True))\n"


def check(folder: Path, code: str, until: float = 0.2) -> str:
    run = run_script(folder, NEAR + REFUSED + code, "--strict", until=until)
    assert (run.stderr, run.returncode) == ("", 0)
    return run.stdout


def test_a_configuration_brings_objects_and_joints_back(tmp_path: Path) -> None:
    body = """
base, joint, tip = sim.createDummy(0.1), sim.createJoint(sim.joint_revolute), sim.createDummy(0.1)
sim.setObjectParent(joint, base)
sim.setObjectParent(tip, joint)
sim.setObjectPosition(tip, [1, 0, 0], joint)
sim.setJointPosition(joint, 0.5)
kept = sim.getConfigurationTree(base)
before = sim.getObjectPose(tip)
sim.setJointPosition(joint, -1)
sim.setObjectPosition(base, [3, 3, 3])
assert sim.setConfigurationTree(kept) == 1
assert near(sim.getObjectPose(tip), before) and sim.getJointPosition(joint) == 0.5
one = sim.getObjectConfiguration(base)
sim.setObjectPosition(base, [5, 5, 5])
sim.setObjectConfiguration(one)
assert near(sim.getObjectPosition(base), [0, 0, 0])
assert 'no configuration' in refused(sim.setConfigurationTree, b'abc')
"""
    check(tmp_path, in_init(body))


def test_the_motion_of_a_joint_is_a_matrix_and_a_pose(tmp_path: Path) -> None:
    body = """
import math
joint, slide = sim.createJoint(sim.joint_revolute), sim.createJoint(sim.joint_prismatic)
sim.setJointPosition(joint, math.pi / 2)
assert near(sim.getJointMatrix(joint), [0, -1, 0, 0, 1, 0, 0, 0, 0, 0, 1, 0])
sim.setObjectChildPose(slide, [0, 0, 0.25, 0, 0, 0, 1])
assert sim.getJointPosition(slide) == 0.25 and near(sim.getObjectChildPose(slide), [0, 0, 0.25, 0, 0, 0, 1])
"""
    check(tmp_path, in_init(body))


def test_a_joint_follows_another_one(tmp_path: Path) -> None:
    code = """
def sysCall_init():
    self.leader, self.follower = (sim.createJoint(sim.joint_revolute) for _ in range(2))
    sim.setJointDependency(self.follower, self.leader, 0.1, -2.0)
    assert sim.getJointDependency(self.follower) == (self.leader, 0.1, -2.0)
    assert sim.getJointDependency(self.leader) == (-1, 0.0, 1.0)
    sim.setJointPosition(self.leader, 0.3)
def sysCall_cleanup():
    assert near([sim.getJointPosition(self.follower)], [0.1 - 2 * 0.3])
"""
    check(tmp_path, code)


def test_objects_keep_handles_by_a_tag(tmp_path: Path) -> None:
    body = """
owner, one, two = (sim.createDummy(0.1) for _ in range(3))
sim.setReferencedHandles(owner, [one, -1, two])
sim.setReferencedHandles(owner, [two], 'tag')
assert sim.getReferencedHandles(owner) == [one, -1, two] and sim.getReferencedHandles(owner, 'tag') == [two]
assert sim.getReferencedHandlesTags(owner) == ['', 'tag'] and sim.getReferencedHandles(one) == []
sim.removeObjects([two])
assert sim.getReferencedHandles(owner) == [one, -1, -1]
assert sim.getObjectFromUid(sim.getObjectUid(one)) == one and sim.getObjectFromUid(two) == -1
assert sim.getObjectHierarchyOrder(one) == sim.getObjectHierarchyOrder(owner) + 1
"""
    check(tmp_path, in_init(body))


def test_persistent_data_are_kept_by_a_tag(tmp_path: Path) -> None:
    body = """
sim.persistentDataWrite('a', b'1')
assert sim.persistentDataRead('a') == b'1' and sim.persistentDataRead('b') is None
assert sim.getPersistentDataTags() == ['a']
sim.persistentDataWrite('a', '')
assert sim.persistentDataRead('a') is None
assert sim.copyTable({'a': [1, {'b': 2}]}) == {'a': [1, {'b': 2}]}
"""
    check(tmp_path, in_init(body))


def test_old_collections_have_names(tmp_path: Path) -> None:
    body = """
first = sim.getCollectionHandle('robot')
assert sim.getCollectionName(first) == 'robot'
ball = sim.getObject('/Ball')
assert sim.addObjectToCollection(first, ball, sim.handle_single) == 1 and ball in sim.getCollectionObjects(first)
sim.setCollectionName(first, 'other')
assert sim.getCollectionHandle('other') == first
sim.removeCollection(first)
assert 'no collection' in refused(sim.getCollectionName, first)
assert sim.isObjectInSelection(ball) == 0 and sim.setObjectSelection([ball]) == 1 and sim.isObjectInSelection(ball) == 1
"""
    check(tmp_path, in_init(body))


def test_a_refused_change_is_a_warning_and_the_script_goes_on(tmp_path: Path) -> None:
    code = """
def sysCall_init():
    link = sim.getObject('/Tricycle/base_link')
    for _ in range(2):
        sim.setObjectParent(link, -1)
        sim.setObjectInt32Param(sim.getObject('.'), sim.shapeintparam_respondable, 0)
    print('goes on')
"""
    run = run_script(tmp_path, code, scene="tricycle", target="/Tricycle")
    assert "goes on" in run.stdout
    assert run.stderr.count("sim.setObjectParent has no effect") == 1
    assert "is a part of /Tricycle and stays there" in run.stderr
    assert "collides as the scene's file defines" in run.stderr
