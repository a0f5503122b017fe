# SPDX-License-Identifier: BSD-3-Clause
"""simIK: a planar arm against its closed form, and a six-axis arm."""

import json
import math
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from bubblesim.geometry import poses, rotations
from bubblesim.scripting.api.ik.environment import PRISMATIC, REVOLUTE, Element, Environment, Group
from bubblesim.scripting.api.ik.solver import DAMPED, SUCCESS, Solver
from node_support import run_script

pytest.importorskip("PyKDL")

# Denavit and Hartenberg's parameters of a UR5 (a, d, alpha), from its maker's page.
UR5 = [
    (0, 0.089159, math.pi / 2),
    (-0.425, 0, 0),
    (-0.39225, 0, 0),
    (0, 0.10915, math.pi / 2),
    (0, 0.09465, -math.pi / 2),
    (0, 0.0823, 0),
]


class Arm:
    """An arm in an environment, with a group for its tip."""

    def __init__(self, chain: list[tuple[float, float, float]], constraints: int = 31) -> None:
        self.environment = Environment()
        parent, offset = -1, list(poses.IDENTITY)
        self.joints = []
        for a, d, alpha in chain:
            joint = self.environment.add("joint", is_joint=True, joint_type=REVOLUTE)
            joint.parent, joint.pose = parent, offset
            self.joints.append(joint)
            parent, offset = joint.handle, [a, 0, d, *rotations.quaternion_of_euler([alpha, 0, 0])]
        tip, self.target = (self.environment.add(name, is_joint=False) for name in ("tip", "target"))
        tip.parent, tip.pose, tip.target = parent, offset, self.target.handle
        self.tip = tip
        self.group = Group(0, "", method=DAMPED, damping=0.05, iterations=50)
        self.group.elements = [Element(tip.handle, -1, constraints=constraints)]
        self.solver = Solver(self.environment)

    def pose_at(self, angles: Any) -> list[float]:
        for joint, angle in zip(self.joints, angles, strict=True):
            joint.position = float(angle)
        return self.environment.pose(self.tip.handle)


def dh(theta: float, a: float, d: float, alpha: float) -> Any:
    c, s, ca, sa = math.cos(theta), math.sin(theta), math.cos(alpha), math.sin(alpha)
    return np.array([[c, -s * ca, s * sa, a * c], [s, c * ca, -c * sa, a * s], [0, sa, ca, d], [0, 0, 0, 1]])


def test_forward_kinematics_is_the_product_of_denavit_and_hartenbergs_matrices() -> None:
    arm, random = Arm(UR5), np.random.default_rng(3)
    for _ in range(20):
        angles = random.uniform(-3, 3, 6)
        expected = np.linalg.multi_dot([dh(t, *p) for t, p in zip(angles, UR5, strict=True)])
        pose = arm.pose_at(angles)
        np.testing.assert_allclose(rotations.matrix_of_pose(pose), expected[:3].ravel(), atol=1e-12)


def test_the_jacobian_is_the_derivative() -> None:
    arm = Arm(UR5, constraints=7)
    angles = [0.3, -1.0, 0.8, 0.5, -0.4, 0.2]
    arm.environment.set_pose(arm.target.handle, arm.pose_at(angles))
    _, jacobian, _, _ = arm.solver.errors(arm.group)
    for number in range(6):
        moved = list(angles)
        moved[number] += 1e-6
        difference = (np.array(arm.pose_at(moved)[:3]) - np.array(arm.pose_at(angles)[:3])) / 1e-6
        np.testing.assert_allclose(jacobian[:, number], difference, atol=1e-5)


def test_reachable_poses_of_a_six_axis_arm_are_found() -> None:
    arm, random = Arm(UR5), np.random.default_rng(1)
    reached, count = 0, 200
    for _ in range(count):
        goal = arm.pose_at(random.uniform(-np.pi, np.pi, 6))
        arm.environment.set_pose(arm.target.handle, goal)
        arm.pose_at([0.0, -1.0, 1.0, 0.0, 0.5, 0.0])
        found = arm.solver.search(arm.group, arm.joints, 2.0, lambda config: True, random)
        if found:
            pose = arm.pose_at(found[0])
            assert math.dist(pose[:3], goal[:3]) <= 1e-5
            reached += 1
    assert reached >= 0.99 * count


def test_a_six_axis_arm_is_solved_within_the_limits_of_its_joints() -> None:
    arm, random = Arm(UR5), np.random.default_rng(2)
    for joint in arm.joints:
        joint.cyclic, joint.low, joint.high = False, -1.5, 2.5
    for _ in range(20):
        goal = arm.pose_at(random.uniform(-1.5, 2.5, 6))
        arm.environment.set_pose(arm.target.handle, goal)
        start = [0.1, -0.5, 0.7, 0.2, 0.5, 0.1]
        arm.pose_at(start)
        found = arm.solver.search(arm.group, arm.joints, 5.0, lambda config: True, random)
        assert [joint.position for joint in arm.joints] == start
        assert len(found) == 1
        assert all(-1.5 <= angle <= 2.5 for angle in found[0])
        assert math.dist(arm.pose_at(found[0])[:3], goal[:3]) <= 1e-5


def test_a_target_that_the_arm_itself_moves_is_solved_by_steps() -> None:
    arm, random = Arm([(1.0, 0, 0), (1.0, 0, 0)], constraints=7), np.random.default_rng(1)
    arm.target.parent = arm.joints[0].handle  # on the first link, 1 m beside the shoulder
    arm.environment.structure += 1
    arm.target.pose = [1.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0]
    found = arm.solver.search(arm.group, arm.joints, 2.0, lambda config: True, random)
    assert math.sin(found[0][1]) == pytest.approx(1.0, abs=1e-4)  # the elbow alone counts


def test_limits_of_joints_are_kept() -> None:
    arm = Arm([(1.0, 0, 0), (1.0, 0, 0)], constraints=3)
    for joint in arm.joints:
        joint.cyclic, joint.low, joint.high = False, 0.0, 2.0  # the elbow bends one way only
    arm.environment.set_pose(arm.target.handle, [0.0, 1.2, 0, 0, 0, 0, 1])
    random = np.random.default_rng(1)
    found = arm.solver.search(arm.group, arm.joints, 2.0, lambda config: True, random, most=3)
    # Law of cosines: the elbow is at +-acos((x^2 + y^2 - 2) / 2).
    elbow = math.acos((1.2**2 - 2) / 2)
    assert [pytest.approx([math.pi / 2 - elbow / 2, elbow], abs=1e-4)] == found


def test_a_group_is_handled_within_its_precision() -> None:
    arm = Arm([(1.0, 0, 0), (1.0, 0, 0)], constraints=3)
    arm.pose_at([0.2, 0.5])
    arm.environment.set_pose(arm.target.handle, [0.8, 1.0, 0, 0, 0, 0, 1])
    result, reason, left = arm.solver.handle(arm.group)
    assert (result, reason) == (SUCCESS, 0)
    assert left[0] <= 0.0005
    arm.environment.set_pose(arm.target.handle, [3.0, 0, 0, 0, 0, 0, 1])  # out of reach
    assert arm.solver.handle(arm.group)[0] != SUCCESS


def test_prismatic_and_dependent_joints_move() -> None:
    environment = Environment()
    first, second = (environment.add(name, is_joint=True, joint_type=PRISMATIC) for name in ("first", "second"))
    second.parent, second.dependency = first.handle, (first.handle, 0.1, 2.0)
    first.position = 0.3
    environment.follow_dependencies()
    assert environment.pose(second.handle, moved=True)[2] == pytest.approx(0.3 + 0.1 + 0.6)


ARM = """<sdf version="1.9"><world name="arm">
  <physics type="ode"><max_step_size>0.005</max_step_size></physics>
  <model name="Arm">
    <link name="base"><inertial><mass>1</mass></inertial></link>
    <joint name="world" type="fixed"><parent>world</parent><child>base</child></joint>
    <link name="upper"><inertial><pose>0.5 0 0 0 0 0</pose><mass>1</mass></inertial></link>
    <link name="lower"><pose>1 0 0 0 0 0</pose><inertial><pose>0.5 0 0 0 0 0</pose><mass>1</mass></inertial></link>
    <joint name="shoulder" type="revolute"><parent>base</parent><child>upper</child>
      <axis><xyz>0 0 1</xyz><limit><lower>-3</lower><upper>3</upper><effort>100</effort></limit></axis></joint>
    <joint name="elbow" type="revolute"><parent>upper</parent><child>lower</child>
      <axis><xyz>0 0 1</xyz><limit><lower>-3</lower><upper>3</upper><effort>100</effort></limit></axis></joint>
  </model>
</world></sdf>
"""


def test_an_arm_of_the_scene_reaches_a_target(tmp_path: Path) -> None:
    (tmp_path / "arm.sdf").write_text(ARM)
    code = """
        import json
        def sysCall_init():
            tip, target = sim.createDummy(0.01), sim.createDummy(0.01)
            sim.setObjectPosition(tip, [2, 0, 0])
            sim.setObjectParent(tip, sim.getObject('/Arm/lower'), True)
            sim.setObjectPosition(target, [1.2, 0.9, 0])
            env = simIK.createEnvironment()
            group = simIK.createIkGroup(env)
            simIK.setIkGroupCalculation(env, group, simIK.method_damped_least_squares, 0.1, 100)
            element, to_own, to_scene = simIK.addIkElementFromScene(
                env, group, sim.getObject('/Arm'), tip, target, simIK.constraint_x | simIK.constraint_y)
            result = simIK.applyIkEnvironmentToScene(env, group)
            print(json.dumps([result, sim.getObjectPosition(tip), len(to_own),
                              sorted(simIK.getObjects(env, i)[1] for i in range(5))]))
    """
    run = run_script(tmp_path, code, "--strict", scene=str(tmp_path / "arm.sdf"), target="/Arm", until=0.05)
    assert "failed" not in run.stderr
    result, position, count, names = json.loads(run.stdout)
    assert result == SUCCESS
    assert position == pytest.approx([1.2, 0.9, 0], abs=1e-3)
    assert count == 5
    assert {"shoulder", "elbow"} <= set(names)
