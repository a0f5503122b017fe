# SPDX-License-Identifier: BSD-3-Clause
"""The official client loads models by the names of CoppeliaSim's model browser."""

from pathlib import Path

import pytest

import bubblesim
from bubblesim.scripting.api.sim.browser_models import BROWSER_MODELS
from remote_support import RemoteNode, refusal


def test_a_client_loads_each_model_of_the_browser(tmp_path: Path) -> None:
    with RemoteNode(tmp_path, "--speed", "max", scene="p3dx_floor") as node:
        sim = node.sim()
        sim.removeModel(sim.getObject("/PioneerP3DX"))
        for model in BROWSER_MODELS:
            base = sim.loadModel(f"./models/robots/mobile/{model.files[-1]}.ttm")
            assert sim.getObjectAlias(base).startswith(model.object)
            sim.removeModel(base)
        assert "did you mean 'UR10'?" in refusal(sim.loadModel, "models/robots/non-mobile/UR-100.ttm")


@pytest.mark.parametrize(
    ("file", "motors"),
    [
        ("pioneer p3dx", "/PioneerP3DX/leftMotor /PioneerP3DX/rightMotor"),
        ("line tracer", "/LineTracer/DynamicLeftJoint /LineTracer/DynamicRightJoint"),
        ("bubbleRob", "/bubbleRob/leftMotor /bubbleRob/rightMotor"),
    ],
)
def test_a_client_that_commands_the_motors_drives_a_robot_with_a_script(tmp_path: Path, file: str, motors: str) -> None:
    with RemoteNode(tmp_path, "--speed", "max", scene="p3dx_floor") as node:
        sim = node.sim()
        sim.removeModel(sim.getObject("/PioneerP3DX"))
        sim.loadModel(f"models/robots/mobile/{file}.ttm")
        left, right = map(sim.getObject, motors.split())
        sim.setStepping(True)
        sim.startSimulation()
        for _ in range(20):
            sim.step()
        assert sim.getJointTargetVelocity(left) > 0.1  # of the script
        for _ in range(20):
            sim.setJointTargetVelocity(left, -1)
            sim.setJointTargetVelocity(right, 1)
            sim.step()
        assert sim.getJointVelocity(left) == pytest.approx(-1, abs=0.02)
        assert sim.getJointVelocity(right) == pytest.approx(1, abs=0.02)
        sim.stopSimulation()


def test_a_program_for_an_arm_with_a_gripper_runs_unchanged(tmp_path: Path) -> None:
    with RemoteNode(tmp_path, "--speed", "max", scene="p3dx_floor") as node:
        sim = node.sim()
        arm = sim.loadModel("models/robots/non-mobile/UR5.ttm")
        sim.setObjectPosition(arm, [1.5, 0, 0])
        sim.removeObjects([sim.getObject("/UR5/Script")])
        gripper = sim.loadModel("models/components/grippers/RG2.ttm")
        connection = sim.getObject("/UR5/connection")
        sim.setObjectPose(gripper, [0, 0, 0, 0, 0, 0, 1], connection)
        sim.setObjectParent(gripper, connection, True)
        joints = [sim.getObject("/UR5" + "/joint/link" * i + "/joint") for i in range(6)]
        sim.setStepping(True)
        sim.startSimulation()
        for joint, position in zip(joints, (0.5, 0.7, -0.9, 0.4, -1.0, 0.8), strict=True):
            sim.setJointTargetPosition(joint, position)
        sim.setInt32Signal("RG2_open", 1)
        while sim.getSimulationTime() < 3:
            sim.step()
        assert sim.getObject("/UR5/RG2/openCloseJoint") > 0
        assert abs(sim.getJointPosition(sim.getObject("/RG2/openCloseJoint")) - 0.055) < 2e-3
        tip, flange = sim.getObject("/RG2/attachPoint"), sim.getObjectParent(connection)
        assert sim.getObjectPosition(tip, flange) == pytest.approx([0, 0, 0.185], abs=5e-3)
        sim.stopSimulation()


def test_two_models_of_a_kind_are_saved_with_their_trees(tmp_path: Path) -> None:
    with RemoteNode(tmp_path, "--speed", "max", "--remote-trusted", scene="p3dx_floor") as node:
        sim = node.sim()
        for x in (1, 2):
            sim.setObjectPosition(sim.loadModel("UR5.ttm"), [x, 0, 0])
        sim.loadModel("Walking Bill.ttm")
        sim.saveScene(str(tmp_path / "arms.sdf"))
    saved = bubblesim.Simulation(str(tmp_path / "arms.sdf"))
    assert saved.object("/UR5[1]/joint/link/joint").joint_position == 0
    assert saved.object("/UR5[1]").position[0] - saved.object("/UR5[0]").position[0] == pytest.approx(1, abs=1e-6)
