# SPDX-License-Identifier: BSD-3-Clause
"""Functions of `sim` about the scene's joints, object trees and the time step, and the callbacks for pauses."""

from pathlib import Path

import pytest

from node_support import Node, run_script, without_slowness, write
from ros_support import RosCore, free_port, ros_environment, wait_until


def check(folder: Path, code: str, name: str = "script.py", scene: str = "tricycle", until: float = 0.1) -> str:
    """Run the script, whose failure fails the test, and return what it printed."""
    target = "/Tricycle" if scene == "tricycle" else "/Ball"
    run = run_script(folder, code, "--strict", name=name, scene=scene, target=target, until=until)
    assert (run.stderr, run.returncode) == ("", 0)
    return run.stdout


def test_joints_have_their_type_mode_and_limits(tmp_path: Path) -> None:
    code = """
        import math
        def sysCall_init():
            steering, motor = sim.getObject('/Steering'), sim.getObject('/FrontMotor')
            assert sim.getJointType(steering) == sim.joint_revolute
            assert sim.getJointMode(steering) == (sim.jointmode_dynamic, 0)
            assert sim.getJointInterval(steering) == (False, [-1.5, 3.0])
            assert sim.getJointInterval(motor) == (True, [-math.pi, 2 * math.pi])
    """
    check(tmp_path, code)


def test_they_do_in_lua(tmp_path: Path) -> None:
    code = """
        function sysCall_init()
          local steering = sim.getObject('/Steering')
          assert(sim.getJointType(steering) == sim.joint_revolute_subtype)
          local cyclic, interval = sim.getJointInterval(steering)
          assert(cyclic == false and interval[1] == -1.5 and interval[2] == 3.0)
          sim.setJointPosition(steering, 0.5)
          assert(math.abs(sim.getJointPosition(steering) - 0.5) < 1e-9)
          local joints = sim.getObjectsInTree(sim.getObject('.'), sim.object_joint_type)
          assert(#joints == 4)
          self.kept = true
          assert(sim.getModuleName(0) == nil)
        end
    """
    check(tmp_path, code, name="script.lua")


def test_what_hangs_on_a_joint_is_put_where_it_should_be(tmp_path: Path) -> None:
    code = """
        import math
        def sysCall_init():
            steering, motor, body = (sim.getObject(path) for path in ('/Steering', '/FrontMotor', '/base_link'))
            before, wheel = sim.getObjectPose(body), sim.getObjectPosition(motor)
            for angle in (0.7, -1.0, 0.2):
                sim.setJointPosition(steering, angle)
                assert math.isclose(sim.getJointPosition(steering), angle, abs_tol=1e-9)
            assert sim.getObjectPose(body) == before
            # The wheel, attached to the fork, is on the steering axis and has turned with it.
            assert math.dist(sim.getObjectPosition(motor), wheel) < 1e-9
            sim.setJointPosition(motor, 2.0)
            assert math.isclose(sim.getJointPosition(motor), 2.0, abs_tol=1e-9)
            assert math.isclose(sim.getJointPosition(steering), 0.2, abs_tol=1e-9)
    """
    check(tmp_path, code)


@pytest.mark.parametrize("position", ["math.nan", "math.inf", "1e7"])
def test_a_joint_goes_nowhere_impossible(tmp_path: Path, position: str) -> None:
    code = f"import math\ndef sysCall_init(): sim.setJointPosition(sim.getObject('/Steering'), {position})\n"
    run = run_script(tmp_path, code, scene="tricycle", target="/Tricycle")
    assert "/Steering: the position" in run.stderr
    assert "is not usable: it must be finite and at most 1e6" in run.stderr


def test_trees_of_objects_are_listed(tmp_path: Path) -> None:
    code = """
        def sysCall_init():
            trike, motor = sim.getObject('.'), sim.getObject('/FrontMotor')
            tree = sim.getObjectsInTree(trike)
            assert tree[0] == trike and motor in tree
            assert sim.getObjectsInTree(trike, sim.handle_all, 1) == tree[1:]
            children = sim.getObjectsInTree(trike, sim.handle_all, 3)
            assert children == [handle for handle in tree if sim.getObjectParent(handle) == trike]
            joints = sim.getObjectsInTree(trike, sim.object_joint_type)
            assert motor in joints and len(joints) == 4
            everything = sim.getObjectsInTree(sim.handle_scene)
            assert set(tree) < set(everything)
            models = sim.getObjectsInTree(sim.handle_scene, sim.handle_all, 2)
            assert trike in models and all(sim.getObjectParent(model) == -1 for model in models)
    """
    check(tmp_path, code)


def test_the_time_step_changes_from_this_pass_on(tmp_path: Path) -> None:
    code = """
        import math
        def sysCall_init():
            self.times, self.ball = [], sim.getObject('.')
        def sysCall_actuation():
            self.times.append(sim.getSimulationTime())
            if len(self.times) == 3:
                sim.setSimulationTimeStep(0.02)
                assert sim.getSimulationTimeStep() == 0.02
        def sysCall_cleanup():
            expected = [0.0, 0.05, 0.1, 0.12, 0.14, 0.16, 0.18]
            assert all(math.isclose(*pair, abs_tol=1e-9) for pair in zip(self.times, expected, strict=True)), self.times
            assert math.isclose(sim.getSimulationTime(), 0.2)
    """
    check(tmp_path, code, scene="ball", until=0.2)


def test_a_body_falls_by_any_time_step_alike(tmp_path: Path) -> None:
    def height(seconds: str) -> float:
        code = f"""
            def sysCall_init():
                sim.setObjectPosition(sim.getObject('.'), [0, 5, 50])
                sim.setSimulationTimeStep({seconds})
            def sysCall_cleanup(): print(sim.getObjectPosition(sim.getObject('.'))[2])
        """
        return float(check(tmp_path, code, scene="ball", until=1.0))

    fallen = [50 - height(seconds) for seconds in ("0.05", "0.1", "0.004", "0.0125")]
    assert fallen == pytest.approx([9.81 / 2] * 4, abs=0.03)  # Euler integration: half a substep of 9.81 m/s too far


@pytest.mark.parametrize("seconds", ["0", "-1", "11", "1e-5", "float('nan')"])
def test_time_steps_that_are_none_are_refused(tmp_path: Path, seconds: str) -> None:
    run = run_script(tmp_path, f"def sysCall_init(): sim.setSimulationTimeStep({seconds})\n")
    assert "is not usable: it must be from 1e-4 to 10 s" in run.stderr


def test_pauses_are_reported_to_scripts_that_ask(roscore: RosCore, tmp_path: Path) -> None:
    code = """
        def sysCall_init(): print('init')
        def sysCall_suspend(): print('suspend')
        def sysCall_suspended(): self.suspended = True
        def sysCall_resume(): print('resume', self.suspended, sim.getModuleName(0), sim.getModuleName(1))
    """
    script = write(tmp_path / "script.py", code)
    with Node(roscore.env, tmp_path / "log", "ball", "--child-script", f"/Ball={script}") as node:
        node.wait_for_output("init")
        wait_until(lambda: "/sim_ros_interface/unpause" in roscore.state()["services"], "the services")
        roscore.run("rosservice", "call", "/sim_ros_interface/pause")
        node.wait_for_output("suspend\n")
        roscore.run("rosservice", "call", "/sim_ros_interface/unpause")
        node.wait_for_output("resume True RosInterface None\n")
        lines = without_slowness(node.output).splitlines()
        assert [line.split()[0] for line in lines if not line.startswith("plugin ")] == ["init", "suspend", "resume"]


def test_a_pause_of_a_scripts_own_is_reported_in_lua(tmp_path: Path) -> None:
    code = """
        function sysCall_init() sim.pauseSimulation() end
        function sysCall_suspend() print('suspend') sim.startSimulation() end
        function sysCall_resume() print('resume') end
    """
    script = write(tmp_path / "script.lua", code)
    environment = ros_environment(free_port(), tmp_path)
    options = ["ball", "--no-ros", "--speed", "max", "--until", "0.3", "--child-script", f"/Ball={script}"]
    with Node(environment, tmp_path / "log", *options) as node:
        assert node.process.wait(timeout=30) == 0
        assert without_slowness(node.output) == "suspend\nresume\n"
