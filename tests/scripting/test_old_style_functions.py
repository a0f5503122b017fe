# SPDX-License-Identifier: BSD-3-Clause
"""Functions of older versions of CoppeliaSim that are not only other names of present ones."""

from pathlib import Path

import pytest

from node_support import REFUSED, in_init, run_script

NUMBERS = """
assert (sim.boolOr32(12, 10), sim.boolXor32(12, 10)) == (14, 6)
matrix = sim.buildMatrix([1, 2, 3], [0.1, 0.2, 0.3])
copy = sim.copyMatrix(matrix)
assert copy == matrix and copy is not matrix
assert sim.buildIdentityMatrix() == [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0]
pose = sim.buildPose([1, 2, 3], [0.1, 0.2, 0.3])
near(pose[3:], sim.getQuaternionFromMatrix(matrix))
near(sim.poseToMatrix(pose), matrix)
"""
SIGNALS = """
sim.setFloatSignal('f', 1.5)
sim.setInt32Signal('i', 2)
sim.setStringSignal('s', 'text')
assert [sim.getSignalName(0, kind) for kind in (0, 1, 2)] == ['i', 'f', 's'] and sim.getSignalName(1, 0) is None
sim.clearFloatSignal('f')
sim.clearInt32Signal('i')
assert sim.getFloatSignal('f') is None and sim.getInt32Signal('i') is None
"""
OBJECTS = """
car, wheel = sim.getObject('.'), sim.getObject('/base_link')
assert sim.getObjectUniqueIdentifier(car) != sim.getObjectUniqueIdentifier(wheel)
assert len(set(sim.getObjectUniqueIdentifier(sim.handle_all))) > 2
assert sim.getObjectStringParam(car, sim.objstringparam_unique_id)
assert sim.getObjectStringParameter(car, sim.objstringparam_unique_id)[0] == 1
assert 'there is no parameter 12345' in refused(sim.setObjectStringParam, car, 12345, 'kept')
box = sim.createPureShape(0, 8, [0.1, 0.1, 0.1], 1)
sim.setObjectName(box, 'crate')
assert sim.getObject('/crate') == box and sim.getScriptName(car) == 'Tricycle'
assert sim.getObjectBoolParam(box, sim.shapeintparam_static) is False
sim.setObjectBoolParam(box, sim.shapeintparam_static, True)
assert sim.getObjectInt32Param(box, sim.shapeintparam_static) == 1
sim.setObjectFloatParam(box, sim.shapefloatparam_mass, 2.5)
near(sim.getObjectFloatParam(box, sim.shapefloatparam_mass), 2.5)
assert sim.setShapeMassAndInertia(box, 6, [1, 0, 0, 0, 1, 0, 0, 0, 1]) == 1
mass, inertia, _ = sim.getShapeMassAndInertia(box)
near([mass, inertia[0]], [6, 6 * 0.1**2 / 6])  # a cube of even density
near(sim.getShapeInertia(box)[0][:3], inertia[:3])
sim.setShapeInertia(box, [1, 0, 0, 0, 1, 0, 0, 0, 1])
near(sim.getShapeInertia(box)[0][:3], inertia[:3])
sim.setObjectProperty(car, sim.objectproperty_selectable)
assert sim.getObjectProperty(car) == sim.objectproperty_selectable
sim.setModelProperty(car, sim.modelproperty_not_visible)
assert sim.getModelProperty(car) == sim.modelproperty_not_visible
assert sim.addObjectCustomData(car, 7, 'own', 3) == 1 and sim.getObjectCustomData(car, 7) == 'own'
assert sim.getObjectCustomData(car, 8) is None
sim.writeCustomBufferData(car, 'tag', b'\\x00\\x01')
assert sim.readCustomBufferData(car, 'tag') == b'\\x00\\x01' and 'tag' in sim.readCustomStringDataTags(car)
sim.writeCustomBufferData(car, 'tag')
assert sim.readCustomBufferData(car, 'tag') is None
first, second = sim.createDummy(0.01), sim.createDummy(0.01)
assert sim.getLinkDummy(first) == -1 and sim.setLinkDummy(first, second) == 1
assert (sim.getLinkDummy(first), sim.getLinkDummy(second)) == (second, first)
assert sim.setLinkDummy(second, -1) == 1 and sim.getLinkDummy(first) == -1
motor = sim.getObject('/FrontMotor')
sim.setJointForce(motor, 3)
near(sim.getJointMaxForce(motor), 3)
"""
SPHERICAL = """
joint, below = sim.createJoint(sim.joint_spherical), sim.createDummy(0.01)
sim.setObjectPosition(joint, [5, 0, 1])
sim.setObjectPosition(below, [6, 0, 1])
sim.setObjectParent(below, joint, True)
quarter = [0, 0, math.sqrt(0.5), math.sqrt(0.5)]
assert sim.setSphericalJointMatrix(joint, sim.buildMatrixQ([0, 0, 0], quarter)) == 1
near(sim.getObjectPose(below), [5, 1, 1, *quarter])
assert sim.setSphericalJointRotation(joint, [0, 0, 0, 1]) == 1
near(sim.getObjectPose(below), [6, 0, 1, 0, 0, 0, 1])
"""
SELECTION = """
car, motor = sim.getObject('.'), sim.getObject('/FrontMotor')
assert sim.getObjectSel() == [] and sim.getObjectLastSelection() == -1
sim.setObjectSel([car, motor])
assert sim.getObjectSel() == [car, motor]
assert (sim.getObjectSelectionSize(), sim.getObjectLastSelection()) == (2, motor)
"""
PARAMETERS = """
sim.setNamedStringParam('a', '1.5')
assert (sim.getNamedStringParam('a'), sim.getStringNamedParam('a'), sim.getNamedFloatParam('a')) == ('1.5', '1.5', 1.5)
assert sim.setStringNamedParam('b', 'true') == 1 and sim.getNamedBoolParam('b') is True
sim.setNamedStringParam('c', '7')
assert sim.getNamedInt32Param('c') == 7 and sim.getNamedInt32Param('d') is None
car = sim.getObject('.')
sim.setEngineInt32Param(sim.bullet_body_oldfriction, -1, None, 50)
assert sim.getEngineInt32Param(sim.bullet_body_oldfriction) == 50
sim.setEngineFloatParam(sim.bullet_body_friction, car, None, 0.7)
assert sim.getEngineFloatParam(sim.bullet_body_friction, car) == 0.7
sim.setEngineBoolParam(sim.bullet_body_restitution, car, None, True)
assert sim.getEngineBoolParam(sim.bullet_body_restitution, car) is True
"""
SCRIPTS = """
car = sim.getObject('.')
assert sim.getScriptProperty(car) == (sim.scripttype_childscript, car)
assert sim.getScriptExecutionCount() == 0
assert sim.isScriptExecutionThreaded() == sim.isScriptRunningInThread() == sim.getThreadId() == 0
assert sim.getThreadAutomaticSwitch() is True and sim.getThreadSwitchAllowed() == 1
sim.setThreadSwitchAllowed(False)
assert sim.getThreadAutomaticSwitch() is False and sim.getThreadSwitchAllowed() == 0
sim.setThreadSwitchAllowed(True)
assert sim.getThreadSwitchTiming() > 0
sim.setThreadIsFree(True)
sim.setThreadResumeLocation(0, 0)
assert 'sim.getObjectPosition' in sim.getApiFunc(-1, 'sim.getObjectPos')
assert 'x, y, z' in sim.getApiInfo(-1, 'sim.getObjectPosition')
"""


@pytest.mark.parametrize(
    "body",
    [NUMBERS, SIGNALS, OBJECTS, SPHERICAL, SELECTION, PARAMETERS, SCRIPTS],
    ids=["numbers", "signals", "objects", "spherical", "selection", "parameters", "scripts"],
)
def test_functions_of_older_versions_do_what_their_manual_states(tmp_path: Path, body: str) -> None:
    header = f"""
import math
import numpy as np
near = lambda a, b: np.testing.assert_allclose(a, b, atol=1e-9)
{REFUSED}"""
    run = run_script(tmp_path, header + in_init(body), scene="tricycle", target="/Tricycle", until=0.05)
    assert "failed" not in run.stderr
    assert run.returncode == 0
