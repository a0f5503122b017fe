# SPDX-License-Identifier: BSD-3-Clause
"""Joints, sensors and scripts that a script creates."""

from pathlib import Path

import pytest

from node_support import REFUSED, in_init, run_script
from remote_support import RemoteNode, refusal

HEADER = f"""
import math
import numpy as np
near = lambda a, b, tol=1e-9: np.testing.assert_allclose(a, b, atol=tol)
{REFUSED}"""

RANGES = "[0.0, 2.0, 0.1, 0.1, 0.2, 0.2, 0.0, 0.0, 0.1, math.pi / 6, 0.0, 0.01, 0.0, 0.0, 0.0]"


def check(folder: Path, body: str, rest: str = "", until: float = 0.2) -> str:
    """Run `body` in sysCall_init; an error fails the test. Return what it printed."""
    code = f"{HEADER}{in_init(body)}{rest}"
    run = run_script(folder, code, "--strict", scene="tricycle", target="/Tricycle", until=until)
    assert (run.stderr, run.returncode) == ("", 0)
    return run.stdout


def test_an_arm_of_created_joints_moves_as_its_denavit_hartenberg_parameters_define(tmp_path: Path) -> None:
    body = """
first = sim.createJoint(sim.joint_revolute, sim.jointmode_kinematic, 0, [0.1, 0.02])
second = sim.createJoint(sim.joint_prismatic, sim.jointmode_kinematic, 0)
plate = sim.createPrimitiveShape(sim.primitiveshape_cuboid, [0.2, 0.1, 0.05])
assert sim.getObjectType(first) == sim.object_joint_type and sim.getJointType(second) == sim.joint_prismatic
sim.setObjectPosition(first, [10, 0, 0.5])
sim.setObjectPosition(second, [11, 0, 0.5])
sim.setObjectPosition(plate, [11, 0, 0.7])
sim.setObjectParent(second, first, True)
sim.setObjectParent(plate, second, True)
sim.setJointPosition(first, math.pi / 2)
near(sim.getObjectPosition(second), [10, 1, 0.5])
near(sim.getObjectPosition(plate), [10, 1, 0.7])
sim.setJointPosition(second, 0.3)
near(sim.getObjectPosition(plate), [10, 1, 1.0])
sim.setJointPosition(second, 9)
assert sim.getJointPosition(second) == 0.5
sim.setJointInterval(second, False, [-2, 4])
sim.setJointPosition(second, 9)
assert sim.getJointPosition(second) == 2 and sim.getJointInterval(second) == (False, [-2, 4])
assert sim.getJointInterval(first)[0] is True
assert 'has the limits of its file' in warned(sim.setJointInterval, sim.getObject('/FrontMotor'), False, [0, 1])
assert 'not a type of joints' in refused(sim.createJoint, 99)
self.joint, self.plate = first, plate
"""
    rest = """
def sysCall_actuation():
    sim.setJointPosition(self.joint, sim.getSimulationTime())
def sysCall_sensing():
    t = sim.getSimulationTime()
    near(sim.getObjectPosition(self.plate), [10 + math.cos(t), math.sin(t), 2.7], 1e-6)
"""
    check(tmp_path, body, rest)


def test_a_created_proximity_sensor_measures_and_moves_with_its_robot(tmp_path: Path) -> None:
    body = f"""
robot = sim.getObject('/Tricycle')
wall = sim.createPrimitiveShape(sim.primitiveshape_cuboid, [0.1, 2, 2])
sim.setObjectPosition(wall, [21.05, 0, 5])
eye = sim.createProximitySensor(sim.proximitysensor_ray_subtype, 16, 1, [3, 3, 2, 2, 1, 1, 0, 0], {RANGES})
assert sim.getObjectType(eye) == sim.object_proximitysensor_type and sim.getObjectAlias(eye) == 'Proximity_sensor'
sim.setObjectPosition(eye, [20, 0, 5])
assert sim.handleProximitySensor(eye)[0] == 0
sim.setObjectOrientation(eye, [0, math.pi / 2, 0])  # z along x
result, distance, point, found, normal = sim.handleProximitySensor(eye)
assert result == 1 and found == wall
near([distance, *point], [1, 0, 0, 1], 1e-6)
near(normal, [0, 0, -1], 1e-6)
sim.setObjectPosition(robot, [20, 0, 5])
sim.setObjectParent(eye, robot, True)
sim.setObjectPosition(robot, [20.5, 0, 5])
near(sim.getObjectPosition(eye), [20.5, 0, 5], 1e-6)
near(sim.handleProximitySensor(eye)[1], 0.5, 1e-6)
sim.setObjectInt32Param(eye, sim.proxintparam_entity_to_detect, robot)
assert sim.handleProximitySensor(eye)[0] == 0
sim.removeObjects([eye])
assert not sim.isHandle(eye)
assert 'is not a proximity sensor' in refused(sim.createProximitySensor, 7, 16, 1, [0] * 8, {RANGES})
assert '12 numbers' in refused(sim.createProximitySensor, 34, 16, 1, [0] * 8, [1, 2])
"""
    check(tmp_path, body)


def test_a_created_camera_shows_what_is_before_it(tmp_path: Path) -> None:
    body = """
wall = sim.createPrimitiveShape(sim.primitiveshape_cuboid, [0.1, 0.5, 0.5])
sim.setShapeColor(wall, None, sim.colorcomponent_ambient_diffuse, [1, 0, 0])
sim.setObjectPosition(wall, [21.05, 0, 50])
eye = sim.createVisionSensor(2, [64, 32, 0, 0], [0.01, 10, math.pi / 2, 0.1, 0.1, 0.1, 0, 0, 0, 0, 0])
sim.setObjectPose(eye, [20, 0, 50, 0, math.sqrt(0.5), 0, math.sqrt(0.5)])
assert sim.getObjectType(eye) == sim.object_visionsensor_type and sim.getVisionSensorRes(eye) == [64, 32]
sim.handleVisionSensor(eye)
data, size = sim.getVisionSensorImg(eye)
image = np.frombuffer(data, np.uint8).reshape(32, 64, 3).astype(int)
red = image[:, :, 0] > image[:, :, 1] + 50
assert size == [64, 32] and red[16, 32] and not red[0, 0] and not red[16, 0]
# The larger side sees 2 m at a distance of 1 m: the wall of 0.5 m is a quarter of it.
assert red[16].sum() == 16 and red[:, 32].sum() == 16
assert 'pixels' in refused(sim.createVisionSensor, 2, [0, 1], [0.01, 10, 1])
"""
    check(tmp_path, body)


def test_a_created_camera_gets_another_resolution(tmp_path: Path) -> None:
    body = """
robot = sim.getObject('/Tricycle')
sim.setObjectPosition(robot, [20, 0, 5])
eye = sim.createVisionSensor(2, [64, 32, 0, 0], [0.01, 10, math.pi / 2, 0.1, 0.1, 0.1, 0, 0, 0, 0, 0])
sim.setObjectPosition(eye, [20, 0, 50])
sim.setObjectParent(eye, robot, True)
sim.setObjectAlias(eye, 'eye')
sim.setObjectInt32Param(eye, sim.visionintparam_resolution_x, 16)
sim.setObjectInt32Param(eye, sim.visionintparam_resolution_y, 48)
assert sim.getVisionSensorRes(eye) == [16, 48] and sim.getObjectInt32Param(eye, sim.visionintparam_resolution_x) == 16
sim.handleVisionSensor(eye)
assert len(sim.getVisionSensorImg(eye)[0]) == 16 * 48 * 3
# The larger side sees 90 degrees.
near(math.tan(sim.getObjectFloatParam(eye, sim.visionfloatparam_perspective_angle) / 2), 1, 1e-6)
assert sim.getObject('/Tricycle/eye') == eye and sim.getObjectParent(eye) == robot
near(sim.getObjectPosition(eye), [20, 0, 50], 1e-6)
sim.setIntArray2Property(eye, 'resolution', [20, 10])
assert sim.getVisionSensorRes(eye) == [20, 10]
assert '1 to 4096 pixels' in refused(sim.setObjectInt32Param, eye, sim.visionintparam_resolution_x, 0)
sim.removeObjects([eye])
assert not sim.isHandle(eye)
"""
    check(tmp_path, body)


def test_a_camera_of_a_file_keeps_its_resolution(tmp_path: Path) -> None:
    body = """
eye = sim.loadModel('e-puck.ttm')
eye = sim.getObject('/ePuck/camera')
before = sim.getVisionSensorRes(eye)
assert 'has the resolution of its file' in warned(sim.setObjectInt32Param, eye, sim.visionintparam_resolution_x, 5)
assert sim.getVisionSensorRes(eye) == before
"""
    check(tmp_path, body)


def test_a_line_of_words_has_its_height_and_is_seen(tmp_path: Path) -> None:
    body = """
short, long = sim.generateTextShape('I', [1, 0, 0], 0.5, True), sim.generateTextShape('IIII', [1, 0, 0], 0.5, True)
for text in (short, long):
    sim.setObjectPosition(text, [20, 0, 50])
assert sim.getObjectType(short) == sim.object_shape_type and sim.isHandle(long)
sim.removeObjects([long])
eye = sim.createVisionSensor(2, [64, 64, 0, 0], [0.01, 10, math.pi / 2, 0, 0, 0, 0, 0, 0, 0, 0])
sim.setObjectPose(eye, [20, 0, 49, 0, 0, 0, 1])  # looks up at it
sim.handleVisionSensor(eye)
data, _ = sim.getVisionSensorImg(eye)
image = np.frombuffer(data, np.uint8).reshape(64, 64, 3).astype(int)
rows = np.flatnonzero((image[:, :, 0] > image[:, :, 1] + 50).any(axis=1))
# 0.5 m of the 2 m that 64 pixels show at a distance of 1 m; its near side is at 0.975 m.
assert abs(len(rows) - 16) <= 1, len(rows)
assert 'a line has 1 to 200 letters' in refused(sim.generateTextShape, '')
"""
    check(tmp_path, body)


@pytest.mark.parametrize("body", ["sim.createScript(1, text)", "sim.addScript(1, text)"])
def test_a_script_begins_in_the_next_step(tmp_path: Path, body: str) -> None:
    code = f"""
text = '''function sysCall_init() print('begun at '..sim.getSimulationTime()) end
function sysCall_cleanup() print('ended') end'''
made = {body}
sim.setObjectParent(made, sim.getObject('.'), True)
assert 'has a script' in refused(lambda: self.add(made))
"""
    code = code.replace(
        "assert 'has a script' in refused(lambda: self.add(made))", "assert sim.getScript(1, made) == made"
    )
    assert check(tmp_path, code, until=0.15).splitlines() == ["begun at 0.05", "ended"]


def test_old_programs_associate_scripts_with_objects(tmp_path: Path) -> None:
    body = """
script = sim.addScript(sim.scripttype_childscript)
sim.setScriptText(script, "function sysCall_init() print(sim.getObjectAlias(sim.getObject('.'))) end")
wheel = sim.getObject('/base_link')
assert sim.associateScriptWithObject(script, wheel) == 1
assert 'has a script' in refused(sim.associateScriptWithObject, script, wheel)
assert 'is not a script of sim.addScript' in refused(sim.setScriptText, wheel, '')
assert 'cannot be added' in refused(sim.createScript, sim.scripttype_main, '')
"""
    assert check(tmp_path, body).splitlines() == ["base_link"]


def test_lua_scripts_add_no_scripts_in_python(tmp_path: Path) -> None:
    code = """
        function sysCall_init()
          local fine, problem = pcall(sim.createScript, 1, "#python\\nprint('never')")
          print(fine, problem:find('may do whatever you may') ~= nil)
        end
    """
    run = run_script(tmp_path, code, "--strict", name="script.lua")
    assert (run.stdout, run.returncode) == ("false\ttrue\n", 0)


def test_a_remote_client_adds_scripts_in_lua_only(tmp_path: Path) -> None:
    with RemoteNode(tmp_path, "--speed", "max") as node:
        sim = node.sim()
        made = sim.createScript(1, "function sysCall_init() end function double(x) return 2 * x end")
        assert "may do whatever you may" in refusal(sim.createScript, 1, "#python\nprint('never')")
        joint = sim.createJoint(sim.joint_revolute, sim.jointmode_kinematic, 0)
        sim.setJointPosition(joint, 0.5)
        assert sim.getJointPosition(joint) == 0.5
        assert sim.getFloatProperty(joint, "jointPosition") == 0.5
        sim.startSimulation()
        sim.setStepping(True)
        sim.step()
        sim.step()
        assert sim.callScriptFunction("double", made, 4) == 8
        sim.stopSimulation()
