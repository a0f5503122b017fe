# SPDX-License-Identifier: BSD-3-Clause
"""Functions of `sim` that create objects, compute with matrices, read parameters, keep data and call scripts."""

from pathlib import Path

import pytest

from node_support import REFUSED, in_init, run_script

HEADER = f"""
import math
import numpy as np
near = lambda a, b, tol=1e-9: np.testing.assert_allclose(a, b, atol=tol)
{REFUSED}"""


def check(folder: Path, body: str, scene: str = "tricycle", target: str = "/Tricycle", rest: str = "") -> str:
    """Run `body` in sysCall_init; an error fails the test. Return what it printed."""
    run = run_script(folder, f"{HEADER}{in_init(body)}{rest}", "--strict", scene=scene, target=target)
    assert (run.stderr, run.returncode) == ("", 0)
    return run.stdout


def test_a_dummy_has_a_pose_in_the_world_and_in_its_parent(tmp_path: Path) -> None:
    body = """
car, wheel = sim.getObject('/Tricycle'), sim.getObject('/FrontMotor')
tip = sim.createDummy(0.01, [1, 0, 0])
assert sim.getObjectType(tip) == sim.object_dummy_type and sim.getObjectParent(tip) == -1
near(sim.getObjectPose(tip), [0, 0, 0, 0, 0, 0, 1])
sim.setObjectPosition(tip, [1, 2, 3])
sim.setObjectOrientation(tip, -1, [0.1, 0.2, 0.3])
sim.setObjectParent(tip, car, True)
near(sim.getObjectPosition(tip), [1, 2, 3])
near(sim.getObjectOrientation(tip), [0.1, 0.2, 0.3])
sim.setObjectPosition(tip, [0.5, 0, 0], car)
near(sim.getObjectPosition(tip, sim.handle_parent), [0.5, 0, 0])
sim.setObjectPosition(car, [7, 8, 0.5])
sim.setObjectOrientation(car, [0, 0, math.pi / 2])
near(sim.getObjectPosition(tip), [7, 8.5, 0.5])
near(sim.getObjectPosition(car, tip), sim.multiplyVector(sim.getPoseInverse(sim.getObjectPose(tip)), [7, 8, 0.5]))
below = sim.createDummy(0.01)
sim.setObjectParent(below, tip, False)
near(sim.getObjectPose(below, tip), [0, 0, 0, 0, 0, 0, 1])
near(sim.getObjectPose(below), sim.getObjectPose(tip))
sim.setObjectParent(below, wheel, True)
near(sim.getObjectPose(below), sim.getObjectPose(tip))
assert 'cannot be attached to itself' in refused(sim.setObjectParent, tip, tip)
"""
    check(tmp_path, body)


def test_a_dummy_that_is_moved_often_keeps_a_rotation(tmp_path: Path) -> None:
    body = """
path, tip = sim.createDummy(0.01), sim.createDummy(0.01)
sim.setObjectQuaternion(tip, [0, 0, -0.49492176346664, 0.86893753978469], path)
for i in range(200):  # the error of the quaternion's length was doubled by each motion
    sim.setObjectPosition(tip, [0.001 * i, 0, 0], path)
    sim.setObjectQuaternion(tip, [0, 0, math.sin(i), math.cos(i)], path)
    near(sim.getObjectQuaternion(tip), [0, 0, math.sin(i), math.cos(i)])
"""
    check(tmp_path, body)


def test_dummies_are_found_by_their_names(tmp_path: Path) -> None:
    body = """
car = sim.getObject('/Tricycle')
one, two, top = (sim.createDummy(0.01) for _ in range(3))
for handle in (one, two):
    sim.setObjectAlias(handle, 'tip')
    sim.setObjectParent(handle, car)
assert sim.getObject('/tip') == sim.getObject('/Tricycle/tip') == one
assert sim.getObject('./tip') == sim.getObject(':/tip') == one
assert sim.getObject('/tip[1]') == sim.getObject('/tip', {'index': 1}) == two
assert sim.getObject('/Dummy') == top and sim.getObject('./Dummy', {'noError': True}) == -1
assert sim.getObject('/Nothing/tip', {'noError': True}) == -1
assert sim.getObject('..', {'proxy': one}) == car and sim.getObject('../tip[1]', {'proxy': one}) == two
assert sim.getObjectAlias(one) == 'tip' and sim.getObjectAlias(two, 2) == '/Tricycle/tip[1]'
assert set(sim.getObjectsInTree(car, sim.object_dummy_type)) >= {one, two}
assert top in sim.getObjectsInTree(sim.handle_scene)
assert sim.isHandle(one) and not sim.isHandle(-1) and not sim.isHandle(10**6)
sim.removeObjects([one, top])
assert not sim.isHandle(one) and sim.getObject('/tip') == two
assert 'was removed' in refused(sim.getObjectPosition, one)
"""
    check(tmp_path, body)


def test_parts_of_a_model_are_named_and_painted_but_stay_in_it(tmp_path: Path) -> None:
    body = """
link = sim.getObject('/base_link')
sim.setObjectAlias(link, 'body')
sim.setShapeColor(link, None, sim.colorcomponent_ambient_diffuse, [1, 0, 0])
assert sim.getObject('./body') == link
assert sim.getShapeColor(link, None, sim.colorcomponent_ambient_diffuse) == (1, [1, 0, 0])
assert 'is a part of /Tricycle' in warned(sim.setObjectParent, link, -1)
assert 'remove the whole model' in warned(sim.removeObject, link)
assert sim.isDynamicallyEnabled(link)
"""
    check(tmp_path, body)


def test_matrices_and_poses_agree(tmp_path: Path) -> None:
    body = """
rng = np.random.default_rng(1)
full = lambda m: np.vstack([np.reshape(m, (3, 4)), [0, 0, 0, 1]])
for _ in range(50):
    a, b = (sim.buildMatrix(list(rng.uniform(-5, 5, 3)), list(rng.uniform(-3, 3, 3))) for _ in range(2))
    point = list(rng.uniform(-5, 5, 6))
    near(full(sim.multiplyMatrices(a, b)), full(a) @ full(b))
    near(full(sim.getMatrixInverse(a)), np.linalg.inv(full(a)))
    near(sim.multiplyVector(a, point), np.concatenate([(full(a) @ [*p, 1])[:3] for p in np.reshape(point, (2, 3))]))
    pa, pb = sim.matrixToPose(a), sim.matrixToPose(b)
    near(sim.poseToMatrix(pa), a)
    near(sim.poseToMatrix(sim.multiplyPoses(pa, pb)), sim.multiplyMatrices(a, b))
    near(sim.multiplyVector(pa, point), sim.multiplyVector(a, point))
    near(sim.buildMatrix(a[3::4], sim.getEulerAnglesFromMatrix(a)), a)
    near(sim.interpolateMatrices(a, b, 0), a)
    near(sim.interpolateMatrices(a, b, 1), b)
    axis, angle = sim.getRotationAxis(a, b)
    turned = sim.rotateAroundAxis(a, axis, a[3::4], angle)
    near(full(turned)[:3, :3], full(b)[:3, :3])
    ypr = sim.alphaBetaGammaToYawPitchRoll(0.3, -0.4, 0.5)
    near(sim.yawPitchRollToAlphaBetaGamma(*ypr), [0.3, -0.4, 0.5])
h = sim.getObject('.')
sim.setObjectMatrix(h, a)
near(sim.getObjectMatrix(h), a)
half = sim.interpolatePoses([0] * 6 + [1], [2, 0, 0, 0, 0, 1, 0], 0.5)
near(half, [1, 0, 0, 0, 0, math.sqrt(0.5), math.sqrt(0.5)])
"""
    check(tmp_path, body)


def test_parameters_state_what_they_are(tmp_path: Path) -> None:
    body = """
assert sim.getInt32Param(sim.intparam_program_version) >= 40500
assert sim.getStringParam(sim.stringparam_scene_name) == 'tricycle'
near(sim.getArrayParam(sim.arrayparam_gravity), [0, 0, -9.81], 0.02)
assert sim.getFloatParam(sim.floatparam_simulation_time_step) == sim.getSimulationTimeStep()
assert 0 <= sim.getFloatParam(sim.floatparam_rand) < 1
fps = sim.getInt32Param(sim.intparam_idle_fps)
sim.setInt32Param(sim.intparam_idle_fps, 0)
assert fps == 8 and sim.getInt32Param(sim.intparam_idle_fps) == 0
sim.setBoolParam(sim.boolparam_display_enabled, False)
assert sim.getBoolParam(sim.boolparam_realtime_simulation) is False
gravity = sim.getArrayParam(sim.arrayparam_gravity)
sim.setArrayParam(sim.arrayparam_gravity, [0, 0, -1])
near(sim.getArrayParam(sim.arrayparam_gravity), [0, 0, -1])
sim.setArrayParam(sim.arrayparam_gravity, gravity)
assert 'gravity' in refused(sim.setArrayParam, sim.arrayparam_gravity, [0, 0, float('nan')])
robot, wheel = sim.getObject('.'), sim.getObject('/base_link')
mass, part = sim.getShapeMass(robot), sim.getShapeMass(wheel)
sim.setShapeMass(robot, 2 * mass)
assert sim.getShapeMass(wheel) == 2 * part
sim.setShapeMass(robot, mass)
assert 'the mass' in refused(sim.setShapeMass, wheel, 0)
assert 'there is no intparam 999' in refused(sim.getInt32Param, 999)
motor = sim.getObject('/FrontMotor')
assert sim.getObjectInt32Param(motor, sim.jointintparam_dynctrlmode) == sim.jointdynctrl_velocity
assert sim.getObjectInt32Param(motor, sim.jointintparam_motor_enabled) == 1
near(sim.getObjectFloatParam(motor, sim.jointfloatparam_velocity), sim.getJointVelocity(motor))
assert sim.getModelProperty(sim.getObject('.')) == 0
assert sim.getModelProperty(motor) == sim.modelproperty_not_model
sim.setJointTargetVelocity(motor, 1.0, [1, 2])
sim.setJointMode(motor, sim.jointmode_dynamic, 0)
sim.setJointMode(motor, sim.jointmode_kinematic, 0)
assert sim.getJointMode(motor)[0] == sim.jointmode_kinematic
sim.resetDynamicObject(sim.getObject('/base_link'))
"""
    check(tmp_path, body)


def test_boxes_of_objects_and_models_are_in_the_axes_of_the_object(tmp_path: Path) -> None:
    body = """
box = sim.createPrimitiveShape(sim.primitiveshape_cuboid, [0.2, 0.4, 0.6], 0)
sim.setObjectPose(box, [5, 0, 0, 0, 0, math.sin(0.5), math.cos(0.5)])
sides = [sim.getObjectFloatParam(box, number) for number in range(sim.objfloatparam_objbbox_min_x,
                                                                  sim.objfloatparam_objbbox_max_z + 1)]
near(sides, [-0.1, -0.2, -0.3, 0.1, 0.2, 0.3])
base, model = sim.getObject('/base_link'), sim.getObject('.')
below = sim.getObjectFloatParam(base, sim.objfloatparam_objbbox_min_z)
assert sim.getObjectFloatParam(base, sim.objfloatparam_modelbbox_min_z) < below
assert sim.getObjectFloatParam(model, sim.objfloatparam_modelbbox_max_x) == sim.getObjectFloatParam(
    model, sim.objfloatparam_objbbox_max_x)
assert sim.getObjectFloatParam(sim.createDummy(0.1), sim.objfloatparam_objbbox_max_x) == 0
"""
    check(tmp_path, body)


def test_data_is_kept_by_object_and_name(tmp_path: Path) -> None:
    body = """
h, dummy = sim.getObject('.'), sim.createDummy(0.1)
sim.writeCustomDataBlock(h, 'tag', b'\\x00\\xff')
sim.writeCustomStringData(dummy, 'tag', 'text')
sim.writeCustomTableData(sim.handle_scene, 'table', {'a': [1, 2]})
assert sim.readCustomDataBlock(h, 'tag') == b'\\x00\\xff' and sim.readCustomStringData(dummy, 'tag') == 'text'
assert sim.readCustomTableData(sim.handle_scene, 'table') == {'a': [1, 2]}
assert sim.readCustomDataBlock(h, 'other') is None and sim.readCustomTableData(h, 'other') == {}
assert sim.readCustomDataBlockTags(h) == ['tag']
sim.writeCustomDataBlock(h, 'tag', '')
assert sim.readCustomDataBlockTags(h) == []
sim.setBoolProperty(sim.handle_scene, 'signal.go', True)
sim.setBoolProperty(h, 'customData.go', False)
assert sim.getBoolProperty(sim.handle_scene, 'signal.go') is True and sim.getBoolProperty(h, 'customData.go') is False
sim.setFloatProperty(h, 'customData.x', 0.5)
sim.setBufferProperty(h, 'customData.bytes', b'ab')
assert sim.getFloatProperty(h, 'customData.x') == 0.5 and sim.getBufferProperty(h, 'customData.bytes') == b'ab'
assert 'of type float' in refused(sim.getStringProperty, h, 'customData.x')
sim.removeProperty(h, 'customData.x')
assert sim.getFloatProperty(h, 'customData.x') is None
assert "expected 'customData.NAME'" in refused(sim.setIntProperty, h, 'nothing', 1)
"""
    check(tmp_path, body)


def test_a_script_calls_functions_of_a_script(tmp_path: Path) -> None:
    body = """
me = sim.getScript(sim.scripttype_simulation, sim.getObject('.'))
assert me == sim.getObject('.') == sim.getScript(1, '/Tricycle')
assert sim.getScript(1, '/FrontMotor') == -1
assert sim.callScriptFunction('add', me, 1, 2) == 3
assert sim.callScriptFunction('add', '/Tricycle', 1, 2) == sim.callScriptFunction('add@Tricycle', 1, 1, 2) == 3
assert sim.getScriptFunctions(me).add(3, 4) == 7
assert "has no function 'ad'; did you mean add?" in refused(sim.callScriptFunction, 'ad', me)
assert 'add of the child script of /Tricycle: TypeError' in refused(sim.callScriptFunction, 'add', me)
assert sim.callScriptFunction('add', me, 5, 6) == 11
"""
    check(tmp_path, body, rest="\ndef add(a, b):\n    return a + b\n")


@pytest.mark.parametrize("call", ["sim.loadScene('ball')", "sim.closeScene()"])
def test_a_child_script_loads_no_scene(tmp_path: Path, call: str) -> None:
    name = call.partition("(")[0]
    body = f"assert refused(lambda: {call}) == '{name} is for remote clients; a child script cannot call it'"
    check(tmp_path, body)


def test_lua_has_them_too(tmp_path: Path) -> None:
    code = """
        function double(x) return 2 * x end
        function sysCall_init()
          local tip = sim.createDummy(0.01, {1, 0, 0})
          sim.setObjectAlias(tip, 'tip')
          sim.setObjectParent(tip, sim.getObject('.'), true)
          assert(sim.getObject('./tip') == tip and sim.getObjectAlias(tip) == 'tip')
          local m = sim.buildMatrix({1, 2, 3}, {0, 0, 0})
          assert(#m == 12 and m[4] == 1)
          local p = sim.multiplyVector(m, {1, 1, 1})
          assert(p[1] == 2 and p[2] == 3 and p[3] == 4)
          assert(sim.callScriptFunction('double', sim.getScript(sim.scripttype_simulation, '/Ball'), 4) == 8)
          sim.removeObjects({tip})
          assert(not sim.isHandle(tip))
        end
    """
    run = run_script(tmp_path, code, "--strict", name="script.lua")
    assert (run.stderr, run.returncode) == ("", 0)


CHANGES = """
def change(phase):
    shape = sim.createPrimitiveShape(sim.primitiveshape_cuboid, [0.1, 0.1, 0.1])
    removed = sim.removeObjects([sim.createPureShape(0, 8, [0.1, 0.1, 0.1], 1)])
    print(phase, sim.getObjectAlias(shape), removed)

def sysCall_init():
    change('init')

def sysCall_actuation():
    if sim.getSimulationTime() < 0.06:
        change('actuation')

def sysCall_thread():
    sim.setThreadAutomaticSwitch(False)  # on a slow machine it would be interrupted between two calls
    change('thread')

def sysCall_sensing():
    try:
        change('sensing')
    except RuntimeError as error:
        print(error)
"""


def test_models_come_and_go_in_all_phases_but_sensing(tmp_path: Path) -> None:
    run = run_script(tmp_path, CHANGES, "--strict", scene="ball", target="/Ball", until=0.1)
    assert (run.stderr, run.returncode) == ("", 0)
    refused = "cannot change the world in this phase of a step; change it between steps"
    assert run.stdout.splitlines() == [
        "init Cuboid 1",
        "thread Cuboid_2 1",
        "actuation Cuboid_3 1",
        refused,
        "actuation Cuboid_4 1",
        refused,
    ]


def test_another_thread_of_a_script_changes_no_models(tmp_path: Path) -> None:
    code = """
import threading

def sysCall_init():
    def change():
        try:
            sim.createPrimitiveShape(sim.primitiveshape_cuboid, [0.1, 0.1, 0.1])
        except RuntimeError as error:
            print(error)
    other = threading.Thread(target=change)
    other.start()
    other.join()
    sim.quitSimulator()
"""
    run = run_script(tmp_path, code, "--strict", scene="ball", target="/Ball")
    assert "another thread is running a step" in run.stdout
