# SPDX-License-Identifier: BSD-3-Clause
"""Arms and grippers of CoppeliaSim's browser: where their joints put the flange, and what they hold."""

import math
from pathlib import Path

import numpy as np
import numpy.typing as npt
import pytest

from browser_support import placed, script
from bubblesim.scripting.api.sim.browser_models import BROWSER_MODELS

Matrix = npt.NDArray[np.float64]

UR_LENGTHS = {  # a2, a3, d1, d4, d5, d6 of Universal Robots, m
    "UR3": (-0.24365, -0.21325, 0.1519, 0.11235, 0.08535, 0.0819),
    "UR5": (-0.425, -0.39225, 0.089159, 0.10915, 0.09465, 0.0823),
    "UR10": (-0.612, -0.5723, 0.1273, 0.163941, 0.1157, 0.0922),
}
ARMS = {  # their joints
    "UR3": [f"UR3{'/joint/link' * i}/joint" for i in range(6)],
    "UR5": [f"UR5{'/joint/link' * i}/joint" for i in range(6)],
    "UR10": [f"UR10{'/joint/link' * i}/joint" for i in range(6)],
    "Franka": ["Franka/joint", *(f"Franka/link{i}_resp/joint" for i in range(2, 8))],
    "youBot": [f"youBot/youBotArmJoint{i}" for i in range(5)],
}
UR_POSE = [0.5, 0.7, -0.9, 0.4, -1.0, 0.8]
FRANKA_POSE = [0.3, 0.5, -0.4, -1.8, 0.3, 1.9, 0.7]
POSES = dict.fromkeys(UR_LENGTHS, UR_POSE) | {"Franka": FRANKA_POSE, "youBot": [0.5, 0.6, -0.8, 0.4, 1.0]}


def test_arms_reach_their_targets_and_hold_them_wherever_they_are_put(tmp_path: Path) -> None:
    files = {model.object: model.files[0] for model in BROWSER_MODELS if model.object in ARMS}
    body = f"""
sim.removeModel(sim.getObject('/PioneerP3DX'))
self.joints, self.bases = [], []
for i, (name, joints) in enumerate({ARMS}.items()):
    base = sim.loadModel({files}[name] + '.ttm')
    place = [3 * i - 6, 0, 0.05 if name == 'youBot' else 0.5 * i]
    sim.setObjectPosition(base, place)
    if name == 'UR10':
        sim.setObjectOrientation(base, [1, 0, 0])
    if name != 'youBot':
        self.bases.append((base, sim.getObjectPose(base)))
    for joint, target in zip(joints, {POSES}[name]):
        self.joints.append((sim.getObject('/' + joint), target))
        sim.setJointTargetPosition(self.joints[-1][0], target)
"""
    rest = """
def sysCall_sensing():
    if sim.getSimulationTime() > 4:
        for joint, target in self.joints:
            assert abs(sim.getJointPosition(joint) - target) < 1e-3, sim.getObjectAlias(joint, 2)
        for base, pose in self.bases:
            assert all(abs(a - b) < 1e-4 for a, b in zip(sim.getObjectPose(base), pose)), sim.getObjectAlias(base)
"""
    script(tmp_path, body, rest=rest, until=5)


def test_a_static_arm_moves_along_with_the_robot_that_it_is_attached_to(tmp_path: Path) -> None:
    body = """
self.robot, self.arm = sim.getObject('/PioneerP3DX'), sim.loadModel('UR3.ttm')
sim.setObjectPosition(self.arm, [0, 0, 0.4])
sim.setObjectParent(self.arm, self.robot, True)
sim.setObjectInt32Param(self.arm, sim.shapeintparam_static, 1)
self.before = sim.getObjectPosition(self.arm, self.robot)
for motor in ('leftMotor', 'rightMotor'):
    sim.setJointTargetVelocity(sim.getObject('/PioneerP3DX/' + motor), 4)
self.joints = sim.getObjectsInTree(self.arm, sim.object_joint_type)[:6]
for joint in self.joints:
    sim.setJointTargetPosition(joint, 0.5)
"""
    rest = """
def sysCall_cleanup():
    assert sim.getObjectPosition(self.robot)[0] > 0.7
    assert math.dist(sim.getObjectPosition(self.arm, self.robot), self.before) < 2e-3
    assert all(abs(sim.getJointPosition(joint) - 0.5) < 5e-3 for joint in self.joints)
"""
    script(tmp_path, body, rest=rest, until=3)


def turn(angle: float, axis: int) -> Matrix:
    """The rotation about x (0) or z (2) as a matrix of 4 rows and columns."""
    matrix, (i, j) = np.eye(4), ((axis + 1) % 3, (axis + 2) % 3)
    matrix[i, i] = matrix[j, j] = math.cos(angle)
    matrix[i, j], matrix[j, i] = -math.sin(angle), math.sin(angle)
    return matrix


def shift(x: float, z: float) -> Matrix:
    matrix = np.eye(4)
    matrix[0, 3], matrix[2, 3] = x, z
    return matrix


@pytest.mark.parametrize("name", UR_LENGTHS)
def test_the_flange_of_a_ur_is_where_its_dh_parameters_put_it(name: str) -> None:
    a2, a3, d1, d4, d5, d6 = UR_LENGTHS[name]
    simulation = placed(name)
    offsets = (-math.pi / 2, -math.pi / 2, 0, -math.pi / 2, 0, 0)
    angles = [position + offset for position, offset in zip(UR_POSE, offsets, strict=True)]
    expected = np.eye(4)
    for angle, a, d, alpha in zip(
        angles, (0, a2, a3, 0, 0, 0), (d1, 0, 0, d4, d5, d6), (1, 0, 0, 1, -1, 0), strict=True
    ):
        expected = expected @ turn(angle, 2) @ shift(a, d) @ turn(alpha * math.pi / 2, 0)
    for path, position in zip(ARMS[name], UR_POSE, strict=True):
        simulation.world.set_joint_position(simulation.object(f"/{path}").handle, position)
    assert simulation.object(f"/{name}/connection").position == pytest.approx(expected[:3, 3], abs=1e-5)


def test_the_flange_of_the_panda_is_where_its_dh_parameters_put_it() -> None:
    simulation = placed("Franka")
    parameters = [  # a, d, alpha of Franka Emika, with the turn about x first
        (0, 0.333, 0),
        (0, 0, -1),
        (0, 0.316, 1),
        (0.0825, 0, 1),
        (-0.0825, 0.384, -1),
        (0, 0, 1),
        (0.088, 0, 1),
    ]
    expected = np.eye(4)
    for path, (a, d, alpha), position in zip(ARMS["Franka"], parameters, FRANKA_POSE, strict=True):
        expected = expected @ shift(a, 0) @ turn(alpha * math.pi / 2, 0) @ shift(0, d) @ turn(position, 2)
        simulation.world.set_joint_position(simulation.object(f"/{path}").handle, position)
    flange = expected @ shift(0, 0.107)
    assert simulation.object("/Franka/connection").position == pytest.approx(flange[:3, 3], abs=1e-5)


def test_the_gripper_opens_and_closes_by_its_signal(tmp_path: Path) -> None:
    body = """
self.gripper = sim.loadModel('RG2.ttm')
self.joints = [sim.getObject(f'/RG2/{name}') for name in ('openCloseJoint', 'rightFingerJoint')]
sim.setInt32Signal('RG2_open', 1)
"""
    rest = """
def sysCall_sensing():
    ways = [sim.getJointPosition(joint) for joint in self.joints]
    if abs(sim.getSimulationTime() - 2) < 0.01:
        assert all(abs(way - 0.055) < 1e-3 for way in ways), ways
        sim.setInt32Signal('RG2_open', 0)
    if sim.getSimulationTime() > 3.9:
        assert all(abs(way) < 1e-3 for way in ways), ways
"""
    script(tmp_path, body, rest=rest, until=4)


def test_the_hand_of_the_panda_carries_a_cube(tmp_path: Path) -> None:
    body = f"""
sim.removeModel(sim.getObject('/PioneerP3DX'))
sim.loadModel('FrankaEmikaPanda.ttm')
self.joints = [sim.getObject('/' + path) for path in {ARMS["Franka"]}]
for joint, position in zip(self.joints, (0, 0.3, 0, -1.9, 0, 2.2, 0.78)):
    sim.setJointPosition(joint, position)
hand = '/Franka/FrankaGripper/'
for finger in ('openCloseJoint', 'rightFingerJoint'):
    sim.setJointPosition(sim.getObject(hand + finger), 0.0201)
sim.setJointTargetVelocity(sim.getObject(hand + 'openCloseJoint'), -0.1)
self.tip = sim.getObject(hand + 'attachPoint')
self.cube = sim.createPrimitiveShape(sim.primitiveshape_cuboid, [0.04, 0.04, 0.04])
sim.setObjectInt32Param(self.cube, sim.shapeintparam_static, 0)
sim.setObjectInt32Param(self.cube, sim.shapeintparam_respondable, 1)
sim.setObjectPose(self.cube, sim.getObjectPose(self.tip))
"""
    rest = """
def sysCall_sensing():
    share = min(1, max(0, sim.getSimulationTime() - 0.5) / 2)
    sim.setJointTargetPosition(self.joints[0], 0.8 * share)
    sim.setJointTargetPosition(self.joints[1], 0.3 - 0.3 * share)

def sysCall_cleanup():
    assert math.dist(sim.getObjectPosition(self.cube, self.tip), [0, 0, 0]) < 0.01
    assert sim.getObjectPosition(self.cube)[1] > 0.4 and sim.getObjectPosition(self.cube)[2] > 0.4
"""
    script(tmp_path, body, rest=rest, until=4)


def test_the_fingers_of_the_barrett_hand_hold_a_ball_that_is_pulled(tmp_path: Path) -> None:
    body = """
sim.removeModel(sim.getObject('/PioneerP3DX'))
hand = sim.loadModel('BarrettHand.ttm')
sim.setObjectPosition(hand, [0, 0, 0.5])
sim.setObjectOrientation(hand, [0, 0, 0])  # it looks up
sim.setObjectInt32Param(hand, sim.shapeintparam_static, 1)
self.ball = sim.createPureShape(1, 8, [0.07, 0.07, 0.07], 0.1)
sim.setObjectPosition(self.ball, [0, 0, 0.5 + 0.083 + 0.035])  # on the palm
self.knuckles = [sim.getObject(f'/BarrettHand/jointB_{i}') for i in range(3)]
self.tips = [sim.getObject(f'/BarrettHand/jointC_{i}') for i in range(3)]
for knuckle in self.knuckles:
    sim.setJointTargetVelocity(knuckle, 1)
"""
    rest = """
def sysCall_actuation():
    if sim.getSimulationTime() > 2:
        sim.addForceAndTorque(self.ball, [0, 0, 4])  # four times its weight

def sysCall_cleanup():
    x, y, z = sim.getObjectPosition(self.ball)
    assert math.hypot(x, y) < 0.02 and abs(z - 0.618) < 0.03, (x, y, z)
    for knuckle, tip in zip(self.knuckles, self.tips):
        assert sim.getJointPosition(knuckle) < 0.6  # the ball stops it
        assert abs(sim.getJointPosition(tip) - sim.getJointPosition(knuckle) / 3) < 0.03
"""
    script(tmp_path, body, rest=rest, until=4)
