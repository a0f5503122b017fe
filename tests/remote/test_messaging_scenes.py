# SPDX-License-Identifier: BSD-3-Clause
"""The scenes in the place of those that the examples of CoppeliaSim's client for Python load."""

import math
import threading
from pathlib import Path
from typing import Any

import pytest

from remote_support import RemoteNode
from ros_support import wait_until

TURN = math.radians(90)


def load(node: RemoteNode, name: str) -> Any:
    """Return the `sim` of a client that has loaded the scene by the path of the original."""
    sim = node.sim()
    folder = sim.getStringParam(sim.stringparam_scenedefaultdir)
    assert sim.loadScene(f"{folder}/messaging/{name}ViaRemoteApi.ttt") == 1
    return sim


def positions(sim: Any, arm: str, count: int) -> list[float]:
    return [sim.getJointPosition(sim.getObject(f"{arm}/joint", {"index": i})) for i in range(count)]


def call(sim: Any, arm: str, function: str, *arguments: object) -> Any:
    """Call a function of the arm's child script."""
    return sim.callScriptFunction(f"{function}@{arm}", sim.scripttype_childscript, *arguments)


def has_done(sim: Any, arm: str, name: str) -> None:
    wait_until(lambda: sim.getStringSignal(f"{arm}_executedMovId") == name, f"'{name}' of {arm}")


def test_a_client_controls_the_lever(node: RemoteNode) -> None:
    sim = load(node, "pController")
    joint = sim.getObject("/Cuboid[0]/joint")
    sim.setStepping(True)
    sim.startSimulation()
    for wanted in (TURN / 2, -TURN):
        for _ in range(100):
            sim.setJointTargetVelocity(joint, 5 * (wanted - sim.getJointPosition(joint)))
            sim.step()
        assert sim.getJointPosition(joint) == pytest.approx(wanted, abs=1e-3)


def test_images_pass_through_a_client(node: RemoteNode) -> None:
    sim = load(node, "synchronousImageTransmission")
    active, passive = sim.getObject("/VisionSensor"), sim.getObject("/PassiveVisionSensor")
    sim.setStepping(True)
    sim.startSimulation()
    for _ in range(5):
        image, width, height = sim.getVisionSensorCharImage(active)
        sim.setVisionSensorCharImage(passive, image)
        assert sim.getVisionSensorCharImage(passive)[0] == image
        sim.step()
    assert len(image) == width * height * 3
    assert len(set(image)) > 20  # balls on a floor


def test_arms_carry_out_movements_one_after_the_other(node: RemoteNode) -> None:
    sim = load(node, "movement")
    arms = ("/blueArm", "/redArm")
    sim.startSimulation()
    fast, still = [1.7] * 6, [0.0] * 6
    there = [TURN, TURN, -TURN, TURN, TURN, TURN]
    limits = {"maxVel": fast, "maxAccel": [2.6] * 6}
    for arm in arms:
        has_done(sim, arm, "ready")
        for name, goal, end in (("there", there, [0.5, *still[1:]]), ("back", still, still)):
            movement = {"id": name, "type": "mov", "targetConfig": goal, "targetVel": end, **limits}
            call(sim, arm, "remoteApi_movementDataFunction", movement)
    call(sim, "/blueArm", "remoteApi_executeMovement", "there")
    has_done(sim, "/blueArm", "there")
    assert positions(sim, "/blueArm", 6) == pytest.approx(there, abs=0.1)  # it goes on at 0.5 rad/s
    call(sim, "/blueArm", "remoteApi_executeMovement", "back")
    has_done(sim, "/blueArm", "back")
    assert positions(sim, "/blueArm", 6) == pytest.approx(still, abs=0.01)
    assert positions(sim, "/redArm", 6) == pytest.approx(still, abs=0.01)  # it was not told to move


def test_an_arm_follows_points(node: RemoteNode) -> None:
    sim = load(node, "movement")
    sim.startSimulation()
    has_done(sim, "/redArm", "ready")
    times = [0.05 * i for i in range(41)]
    points = {f"j{number}": [0.2 * number * time for time in times] for number in range(1, 7)}
    call(sim, "/redArm", "remoteApi_movementDataFunction", {"id": "ramp", "type": "pts", "times": times, **points})
    call(sim, "/redArm", "remoteApi_executeMovement", "ramp")
    has_done(sim, "/redArm", "ramp")
    wait_until(
        lambda: positions(sim, "/redArm", 6) == pytest.approx([0.4 * i for i in range(1, 7)], abs=0.02), "6 points"
    )


def test_clients_move_three_arms_at_once(node: RemoteNode) -> None:
    load(node, "movement").client.socket.close()
    goal = [TURN, TURN, math.radians(170), -TURN, TURN, TURN, 0.0]
    found: dict[str, list[float]] = {}

    def move_joints(arm: str) -> None:
        sim = node.sim()
        sim.setStepping(True)
        joints = [sim.getObject(f"{arm}/joint", {"index": i}) for i in range(7)]
        limits = {"maxVel": [1.9] * 7, "maxAccel": [1.5] * 7, "maxJerk": [3.0] * 7}
        sim.moveToConfig({"joints": joints, "targetPos": goal, **limits})
        found[arm] = [sim.getJointPosition(joint) for joint in joints]
        sim.setStepping(False)

    def move_target() -> None:
        sim = node.sim()
        sim.setStepping(True)
        tip, target = sim.getObject("/greenRobot/tip"), sim.getObject("/greenRobot/target")
        pose = sim.getObjectPose(target)
        pose[2] += 0.2
        limits = {"maxVel": [0.5] * 4, "maxAccel": [0.1, 0.1, 0.1, 1.0], "maxJerk": [3.0] * 4}
        sim.moveToPose({"object": target, "targetPose": pose, **limits})
        found["tip"] = sim.getObjectPosition(tip, target)
        sim.setStepping(False)

    threads = [threading.Thread(target=move_joints, args=(arm,)) for arm in ("/blueRobot", "/redRobot")]
    threads.append(threading.Thread(target=move_target))
    sim = node.sim()  # connected before: a movement waits 2 s for the start
    for thread in threads:
        thread.start()
    sim.startSimulation()
    for thread in threads:
        thread.join()
    assert found["/blueRobot"] == pytest.approx(goal, abs=0.01)
    assert found["/redRobot"] == pytest.approx(goal, abs=0.01)
    assert found["tip"] == pytest.approx([0, 0, 0], abs=2e-3)


def test_a_movement_waits_for_the_start_but_not_for_long(node: RemoteNode) -> None:
    sim = load(node, "movement")
    joint = sim.getObject("/blueRobot/joint", {"index": 0})
    movement = {"joints": [joint], "targetPos": [0.5], "maxVel": [1.0], "maxAccel": [1.0], "maxJerk": [10.0]}
    with pytest.raises(Exception, match="the simulation is stopped, its time does not pass"):
        sim.moveToConfig(movement)
    start = threading.Timer(0.1, node.sim().startSimulation)
    start.start()
    sim.moveToConfig(movement)
    start.join()
    assert sim.getJointPosition(joint) == pytest.approx(0.5, abs=0.01)


def test_a_tip_follows_a_target_that_a_client_moves(tmp_path: Path) -> None:
    with RemoteNode(tmp_path, "--speed", "max", scene="p3dx_floor") as node:
        sim = load(node, "ikMovement")
        sim.startSimulation()
        has_done(sim, "/LBR4p", "ready")
        pose, configuration = call(sim, "/LBR4p", "remoteApi_getPoseAndConfig")
        assert len(configuration) == 7
        turned = [*pose[:2], pose[2] - 0.05, math.sqrt(0.5), 0, 0, math.sqrt(0.5)]  # by 90 degrees about x
        movement = {"id": "turn", "type": "mov", "targetPose": turned, "maxVel": 0.1, "maxAccel": 0.05}
        call(sim, "/LBR4p", "remoteApi_movementDataFunction", movement)
        call(sim, "/LBR4p", "remoteApi_executeMovement", "turn")
        has_done(sim, "/LBR4p", "turn")
        assert sim.getObjectPose(sim.getObject("/LBR4p/tip")) == pytest.approx(turned, abs=2e-3)


def test_the_module_with_a_version_is_the_same(node: RemoteNode) -> None:
    client = node.client()
    sim = client.require("sim-2")
    assert sim.getObjectAlias(sim.getObject("/Tricycle")) == "Tricycle"
    assert sim.getVector3Property(sim.handle_scene, "gravity") == pytest.approx([0, 0, -9.8], abs=0.02)
