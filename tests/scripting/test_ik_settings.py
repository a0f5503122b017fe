# SPDX-License-Identifier: BSD-3-Clause
"""simIK: what environments, groups, elements and joints keep, and an arm of two links against its closed form."""

from pathlib import Path

import pytest

from node_support import REFUSED, in_init, run_script

pytest.importorskip("PyKDL")

# Two links of 1 m in a plane; the tip is to reach the target.
ARM = """
env = simIK.createEnvironment()
shoulder, elbow = (simIK.createJoint(env, simIK.jointtype_revolute, name) for name in ('shoulder', 'elbow'))
tip, target = (simIK.createDummy(env, name) for name in ('tip', 'target'))
simIK.setObjectParent(env, elbow, shoulder, False)
simIK.setObjectPose(env, elbow, shoulder, [1, 0, 0, 0, 0, 0, 1])
simIK.setObjectParent(env, tip, elbow, False)
simIK.setObjectPose(env, tip, elbow, [1, 0, 0, 0, 0, 0, 1])
simIK.setTargetDummy(env, tip, target)
for joint in (shoulder, elbow):
    simIK.setJointMode(env, joint, simIK.jointmode_ik)
group = simIK.createGroup(env, 'arm')
element = simIK.addElement(env, group, tip)
simIK.setElementConstraints(env, group, element, simIK.constraint_x | simIK.constraint_y)
"""
KEPT = """
assert simIK.getTargetDummy(env, tip) == target and simIK.getTargetDummy(env, target) == -1
assert simIK.doesObjectExist(env, 'tip') and not simIK.doesObjectExist(env, 'top')
assert simIK.doesGroupExist(env, 'arm') and not simIK.doesGroupExist(env, 'leg')
assert simIK.getGroupHandle(env, 'arm') == group
simIK.setGroupCalculation(env, group, simIK.method_damped_least_squares, 0.2, 40)
assert simIK.getGroupCalculation(env, group) == (simIK.method_damped_least_squares, 0.2, 40)
simIK.setGroupFlags(env, group, simIK.group_enabled)
assert simIK.getGroupFlags(env, group) == simIK.group_enabled
assert simIK.getElementConstraints(env, group, element) == simIK.constraint_x | simIK.constraint_y
simIK.setElementFlags(env, group, element, 0)
assert simIK.getElementFlags(env, group, element) == 0
simIK.setElementFlags(env, group, element, 1)
simIK.setElementPrecision(env, group, element, [1e-5, 1e-3])
near(simIK.getElementPrecision(env, group, element), [1e-5, 1e-3])
simIK.setElementWeights(env, group, element, [1, 0.5])
near(simIK.getElementWeights(env, group, element)[:2], [1, 0.5])
simIK.setElementBase(env, group, element, shoulder)
assert simIK.getElementBase(env, group, element) == (shoulder, -1)
simIK.setElementBase(env, group, element, -1)
simIK.setJointMaxStepSize(env, elbow, 0.2)
simIK.setJointWeight(env, elbow, 0.5)
near([simIK.getJointMaxStepSize(env, elbow), simIK.getJointWeight(env, elbow)], [0.2, 0.5])
simIK.setObjectTransformation(env, target, -1, [1, 2, 3], [0, 0, math.sqrt(0.5), math.sqrt(0.5)])
position, quaternion, angles = simIK.getObjectTransformation(env, target)
near([*position, *quaternion, *angles], [1, 2, 3, 0, 0, math.sqrt(0.5), math.sqrt(0.5), 0, 0, math.pi / 2])
simIK.setJointPosition(env, elbow, 0.4)
position, quaternion, angles = simIK.getJointTransformation(env, elbow)
near([*position, *angles], [0, 0, 0, 0, 0, 0.4])
assert simIK.createDebugOverlay(env, tip) == 0 and simIK.eraseDebugOverlay(0) is None
copy = simIK.duplicateEnvironment(env)
simIK.setJointPosition(copy, elbow, 1.0)
near([simIK.getJointPosition(env, elbow), simIK.getJointPosition(copy, elbow)], [0.4, 1.0])
simIK.eraseGroup(copy, group)
simIK.eraseObject(copy, tip)
assert not simIK.doesGroupExist(copy, 'arm') and not simIK.doesObjectExist(copy, 'tip')
assert simIK.doesGroupExist(env, 'arm')
simIK.eraseEnvironment(copy)
assert 'there is no environment' in refused(simIK.getJointPosition, copy, elbow)
assert simIK.getFailureDescription(0) is not None
ball = simIK.createJoint(env, simIK.jointtype_spherical, 'ball')
below = simIK.createDummy(env, 'below')
simIK.setObjectParent(env, below, ball, False)
quarter = [0, 0, math.sqrt(0.5), math.sqrt(0.5)]
simIK.setSphericalJointRotation(env, ball, quarter)
near(simIK.getObjectPose(env, below)[3:], quarter)
simIK.setSphericalJointMatrix(env, ball, [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0])
near(simIK.getObjectPose(env, below)[3:], [0, 0, 0, 1])
"""
SOLVED = """
a, b = 0.3, 0.9
simIK.setJointPosition(env, shoulder, a)
simIK.setJointPosition(env, elbow, b)
# The tip is at (cos a + cos(a + b), sin a + sin(a + b)).
rows = [[-math.sin(a) - math.sin(a + b), -math.sin(a + b)], [math.cos(a) + math.cos(a + b), math.cos(a + b)]]
jacobian, size = simIK.getJacobian(env, group)
assert list(size) == [2, 2]
near(np.array(jacobian).reshape(2, 2).T, rows)  # column by column
near(np.array(simIK.computeGroupJacobian(env, group)[0]).reshape(2, 2), rows)
near(np.array(simIK.computeJacobian(env, group)[0]).reshape(2, 2), rows)
near(simIK.getManipulability(env, group), abs(math.sin(b)))  # Yoshikawa's, of lengths 1
simIK.setGroupCalculation(env, group, simIK.method_damped_least_squares, 0.05, 100)
simIK.setElementPrecision(env, group, element, [1e-6, 1e-6])
simIK.setObjectPose(env, target, -1, [1.2, 0.9, 0, 0, 0, 0, 1])
result, *_ = simIK.handleGroup(env, group)
assert result == simIK.result_success
near(simIK.getObjectPose(env, tip)[:2], [1.2, 0.9], 1e-5)
bend = math.acos((1.2**2 + 0.9**2 - 2) / 2)  # by the law of cosines
near(abs(simIK.getJointPosition(env, elbow)), bend, 1e-4)
simIK.setObjectPose(env, target, -1, [0.5, 1.0, 0, 0, 0, 0, 1])
assert simIK.handleGroups(env, [group])[0] == simIK.result_success
near(simIK.getObjectPose(env, tip)[:2], [0.5, 1.0], 1e-5)
bend = math.acos((0.5**2 + 1.0**2 - 2) / 2)
joints = [shoulder, elbow]
for config in (
    simIK.findConfig(env, group, joints, 0.5, 2),
    simIK.getConfigForTipPose(env, group, joints, 0.5, 2),
    simIK.findConfigs(env, group, joints, {'maxTime': 2})[0],
):
    near(abs(math.remainder(config[1], math.tau)), bend, 1e-3)
simIK.setJointInterval(env, elbow, False, [-7, 14])
simIK.setJointPosition(env, elbow, 0.5)
elbows = [float(each[1]) for each in simIK.getAlternateConfigs(env, joints)]
near(sorted(set(np.round(elbows, 9))), [0.5 - math.tau, 0.5, 0.5 + math.tau])  # within -7 and 7
simIK.setJointInterval(env, elbow, True, [-math.pi, math.tau])
simIK.handleGroup(env, group)
simIK.setObjectPose(env, target, -1, [0.6, 1.0, 0, 0, 0, 0, 1])
path = np.array(simIK.generatePath(env, group, joints, tip, 11)).reshape(-1, 2)
assert len(path) == 11
for share, (first, second) in zip(np.linspace(0, 1, 11), path):
    x, y = math.cos(first) + math.cos(first + second), math.sin(first) + math.sin(first + second)
    near([x, y], [0.5 + 0.1 * share, 1.0], 1e-3)
simIK.setObjectPose(env, target, -1, [3, 0, 0, 0, 0, 0, 1])
result, reason, *_ = simIK.handleGroup(env, group)
assert result == simIK.result_fail and simIK.getFailureDescription(reason)
"""


def check(folder: Path, body: str, **options: object) -> None:
    header = f"""
import math
import numpy as np
near = lambda a, b, tolerance=1e-9: np.testing.assert_allclose(a, b, atol=tolerance)
{REFUSED}"""
    run = run_script(folder, header + in_init(body), "--strict", **options)  # type: ignore[arg-type]
    assert (run.stderr, run.returncode) == ("", 0)


@pytest.mark.parametrize("body", [KEPT, SOLVED], ids=["kept", "solved"])
def test_an_environment_of_its_own(tmp_path: Path, body: str) -> None:
    check(tmp_path, ARM + body)


def test_positions_go_between_the_scene_and_an_environment(tmp_path: Path) -> None:
    body = """
shoulder, elbow = sim.createJoint(sim.joint_revolute), sim.createJoint(sim.joint_revolute)
base, tip, target = (sim.createDummy(0.01) for _ in range(3))
for child, parent, x in ((shoulder, base, 0), (elbow, shoulder, 1), (tip, elbow, 1)):
    sim.setObjectParent(child, parent, False)
    sim.setObjectPosition(child, [x, 0, 0], parent)
sim.setJointPosition(shoulder, 0.2)
sim.setJointPosition(elbow, 0.7)
sim.setObjectPosition(target, [0.5, 1.0, 0])
env = simIK.createEnvironment()
group = simIK.createGroup(env)
simIK.setGroupCalculation(env, group, simIK.method_damped_least_squares, 0.05, 100)
element, own, _ = simIK.addElementFromScene(env, group, base, tip, target, simIK.constraint_x | simIK.constraint_y)
sim.setJointPosition(elbow, 0.8)
for take, give in ((simIK.syncFromScene, simIK.syncToScene), (simIK.syncFromSim, simIK.syncToSim)):
    sim.setJointPosition(elbow, 0.8)
    take(env, [group])
    near(simIK.getJointPosition(env, own[elbow]), 0.8)
    simIK.setJointPosition(env, own[elbow], 0.9)
    give(env, [group])
    near(sim.getJointPosition(elbow), 0.9)
simIK.applySceneToEnvironment(env, group)
assert simIK.applyEnvironmentToScene(env, group) == simIK.result_success
near(sim.getObjectPosition(tip)[:2], [0.5, 1.0], 1e-3)
sim.setObjectPosition(target, [0.6, 1.0, 0])
assert simIK.handleGroup(env, group, {'syncWorlds': True})[0] == simIK.result_success
near(sim.getObjectPosition(tip)[:2], [0.6, 1.0], 1e-3)
"""
    check(tmp_path, body)
