# SPDX-License-Identifier: BSD-3-Clause
"""Properties by name, and the objects of the interface 'sim-2', in Python and in Lua."""

from pathlib import Path

from node_support import REFUSED, in_init, run_script

HEADER = f"""
import math
import numpy as np
near = lambda a, b, tol=1e-9: np.testing.assert_allclose(a, b, atol=tol)
{REFUSED}"""


def check(folder: Path, body: str, rest: str = "") -> str:
    """Run `body` in sysCall_init; an error fails the test. Return what it printed."""
    run = run_script(folder, f"{HEADER}{in_init(body)}{rest}", "--strict", scene="tricycle", target="/Tricycle")
    assert (run.stderr, run.returncode) == ("", 0)
    return run.stdout


def check_lua(folder: Path, body: str) -> None:
    run = run_script(
        folder, f"function sysCall_init()\n{body}\nend", "--strict", scene="tricycle", target="/Tricycle", name="s.lua"
    )
    assert (run.stderr, run.returncode) == ("", 0)


def test_properties_are_what_the_functions_return(tmp_path: Path) -> None:
    body = """
car, motor, eye = (sim.getObject(path) for path in ('/Tricycle', '/FrontMotor', '/Camera'))
assert sim.getStringProperty(car, 'alias') == 'Tricycle' and sim.getProperty(car, 'objectType') == 'shape'
near(sim.getPoseProperty(car, 'absPose'), sim.getObjectPose(car))
sim.setVector3Property(car, 'absPosition', [1, 2, 3])
near(sim.getObjectPosition(car), [1, 2, 3])
near(sim.getVector3Property(eye, 'position'), sim.getObjectPosition(eye, sim.getObjectParent(eye)))
near(sim.getQuaternionProperty(eye, 'quaternion'), sim.getObjectQuaternion(eye, sim.getObjectParent(eye)))
sim.setFloatProperty(motor, 'targetVelocity', 0.5)
assert sim.getJointTargetVelocity(motor) == sim.getFloatProperty(motor, 'targetVel') == 0.5
assert sim.getIntProperty(motor, 'dynCtrlMode') == sim.jointdynctrl_velocity
assert sim.getHandleProperty(eye, 'parent') == sim.getObjectParent(eye)
assert eye in sim.getHandleArrayProperty(sim.getObjectParent(eye), 'children')
assert list(sim.getIntArrayProperty(eye, 'resolution')) == list(sim.getVisionSensorRes(eye))
near(sim.getVector3Property(sim.handle_scene, 'gravity'), sim.getArrayParam(sim.arrayparam_gravity))
assert sim.getFloatProperty(sim.handle_scene, 'timeStep') == sim.getSimulationTimeStep()
sim.setColorProperty(sim.getObject('/base_link'), 'color.diffuse', [0, 1, 0])
assert sim.getColorProperty(sim.getObject('/base_link'), 'color.diffuse') == [0, 1, 0]
sim.setProperty(sim.handle_scene, 'signal.speed', 2.5)
assert sim.getFloatSignal('speed') == sim.getProperty(sim.handle_scene, 'signal.speed') == 2.5
sim.setProperty(car, 'customData.plan', [1, 2])
assert sim.getProperty(car, 'customData.plan') == sim.getTableProperty(car, 'customData.plan') == [1, 2]
assert "has no property 'targetVelocity'" in refused(sim.getFloatProperty, car, 'targetVelocity')
assert sim.getProperty(car, 'targetVelocity', {'noError': True}) is None
assert "'objectType' cannot be set" in refused(sim.setStringProperty, car, 'objectType', 'joint')
names, number = [], 0
while (found := sim.getPropertyName(motor, number)) is not None:
    names, number = [*names, found[0]], number + 1
assert 'jointPosition' in names and 'resolution' not in names and names == sorted(names)
"""
    check(tmp_path, body)


def test_objects_have_properties_and_methods(tmp_path: Path) -> None:
    body = """
sim2 = require('sim-2')
car, motor = sim2.Object('/Tricycle'), sim2.Object('./FrontMotor')
assert car == sim2.self and car.alias == 'Tricycle' and int(car.handle) == sim.getObject('.')
motor.targetVelocity = 0.25
assert sim.getJointTargetVelocity(motor) == 0.25
near(car.getPosition(), sim.getObjectPosition(sim.getObject('.')))
car.setPosition([4, 5, 6])
near(car.absPosition, [4, 5, 6])
near(motor.getPose(car), sim.getObjectPose(sim.getObject('/FrontMotor'), sim.getObject('/Tricycle')))
assert car.getObject('./FrontMotor') == motor and motor in [each for each in [motor]]
assert sim.Object('/Camera').parent in [sim.Object(h) for h in sim.getObjectsInTree(sim.handle_scene)]
assert car.parent is None and repr(car) == "sim.Object('/Tricycle')"
assert sim.Object('/Camera') in sim.Object('/Camera').parent.children
result, *_ = sim.Object('/FrontSonar').readSensor()
assert result in (0, 1)
near(sim2.scene.gravity, [0, 0, -9.81], 0.02)
tip = sim.Object(sim.createDummy(0.01))
tip.parent = car
assert sim.getObjectParent(tip) == car.handle
tip.remove()
assert not sim.isHandle(int(tip))
try:
    car.wheels
except AttributeError as error:
    assert "neither a property nor a method 'wheels'" in str(error)
else:
    raise AssertionError
"""
    check(tmp_path, body)


def test_lua_has_the_same_objects(tmp_path: Path) -> None:
    check_lua(
        tmp_path,
        """
        local sim = require('sim-2')
        local car, motor = sim.Object('/Tricycle'), sim.self:getObject('./FrontMotor')
        assert(car == sim.self and car.alias == 'Tricycle' and car.handle == sim.getObject('.'))
        motor.targetVelocity = 0.25
        assert(sim.getJointTargetVelocity(motor.handle) == 0.25 and sim.getJointTargetVelocity(motor) == 0.25)
        car:setPosition({4, 5, 6})
        assert(math.abs(car.absPosition[3] - 6) < 1e-9 and math.abs(car:getPosition()[1] - 4) < 1e-9)
        assert(sim.Object('/Camera').parent.children[1] ~= nil and car.parent == nil)
        assert(sim.Object('/Camera').parent.children[1].parent == sim.Object('/Camera').parent)
        assert(math.abs(sim.scene.gravity[3] + 9.81) < 0.02)
        assert(tostring(car) == "sim.Object('/Tricycle')")
        local fine, problem = pcall(function() return car.wheels end)
        assert(not fine and problem:find("neither a property nor a method 'wheels'"), problem)
        """,
    )


def test_properties_have_types_and_flags(tmp_path: Path) -> None:
    body = """
car, motor = sim.getObject('/Tricycle'), sim.getObject('/FrontMotor')
kind, flags, _ = sim.getPropertyInfo(motor, 'targetVelocity')
assert kind == sim.propertytype_float and not flags and sim.getPropertyTypeString(kind) == 'float'
assert sim.getPropertyInfo(car, 'absPose')[0] == sim.propertytype_pose
assert sim.getPropertyInfo(car, 'objectType')[1] & sim.propertyinfo_notwritable
assert sim.getPropertyInfo(car, 'nothing') is None
sim.setProperty(car, 'customData.x', 3)
assert sim.getPropertyInfo(car, 'customData.x')[1] & sim.propertyinfo_removable
known = sim.getProperties(motor)
assert known['jointType'] == sim.getJointType(motor) and known['name'] == 'FrontMotor'
assert sim.getPropertiesInfos(motor)['jointType']['type'] == sim.propertytype_int
sim.setProperties(motor, {'targetVelocity': 0.25, 'targetForce': 2.0})
assert sim.getJointTargetVelocity(motor) == 0.25
assert sim.getBoolProperty(car, 'collidable') and sim.getProperty(car, 'uid') == car
sim.setBoolProperty(car, 'collidable', False)
assert sim.getObjectSpecialProperty(car) & sim.objectspecialproperty_collidable == 0
sim.setIntProperty(sim.handle_app, 'signal.count', 4)
assert sim.getInt32Signal('count') == 4 and sim.getProperty(sim.handle_app, 'platform') == sim.platform_linux
assert car in sim.getProperty(sim.handle_scene, 'objects')
sim.setColorProperty(sim.handle_scene, 'ambientLight', [0.1, 0.2, 0.3])
near(sim.getColorProperty(sim.handle_scene, 'ambientLight'), [0.1, 0.2, 0.3])
turns = [sim.getQuaternionProperty(sim.handle_app, 'randomQuaternion') for _ in range(2)]
near([sum(number * number for number in turn) for turn in turns], [1.0, 1.0])
assert turns[0] != turns[1] and 0 <= sim.getFloatProperty(sim.handle_app, 'randomFloat') < 1
"""
    check(tmp_path, body)
