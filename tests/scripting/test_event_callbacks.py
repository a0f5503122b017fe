# SPDX-License-Identifier: BSD-3-Clause
"""Callbacks for events, as CoppeliaSim's manual describes them: in physics substeps, of sensors, around the run."""

from pathlib import Path

import pytest

from node_support import run_script, run_sim, without_slowness, write
from ttt_files import arm, script
from ttt_files import write as write_ttt


def lines(folder: Path, code: str, *, scene: object = "ball", until: float = 0.2, name: str = "script.py") -> list[str]:
    run = run_script(folder, code, "--strict", scene=str(scene), until=until, name=name)
    assert (run.stderr, run.returncode) == ("", 0)
    return run.stdout.splitlines()


def test_dyn_is_called_before_and_after_each_substep(tmp_path: Path) -> None:
    code = """
        calls = []
        def sysCall_init(): pass
        def sysCall_actuation(): calls.clear()
        def sysCall_dyn(data):
            assert abs(data['dt'] - 0.005) < 1e-12 and data['totalPasses'] == 10
            calls.append((data['passCnt'], data['afterStep'], sim.getObjectPosition(sim.handle_self)[2]))
        def sysCall_sensing():
            assert [call[:2] for call in calls] == [(i, after) for i in range(1, 11) for after in (False, True)]
            for before, after in zip(calls[::2], calls[1::2]):
                assert after[2] < before[2]
            assert calls[-1][2] == sim.getObjectPosition(sim.handle_self)[2]
            print('in order')
    """
    assert lines(tmp_path, code, until=0.1) == ["in order", "in order"]


def test_a_force_of_dyn_acts_for_its_substep_only(tmp_path: Path) -> None:
    code = """
        def sysCall_init():
            sim.setArrayParam(sim.arrayparam_gravity, [0, 0, 0])
            self.mass = sim.getShapeMass(sim.handle_self)
        def sysCall_dyn(data):
            if data['passCnt'] == 3 and not data['afterStep']:
                sim.addForceAndTorque(sim.handle_self, [self.mass, 0, 0], [0, 0, 0])
        def sysCall_sensing(): print(round(sim.getObjectVelocity(sim.handle_self)[0][0], 9))
    """
    assert lines(tmp_path, code, until=0.1) == ["0.005", "0.01"]  # a substep of 5 ms with 1 m/s^2


CALLBACK = 16  # sim.jointdynctrl_callback


def run_arm(folder: Path, lua: str, until: float, control: int = CALLBACK) -> list[str]:
    """Run an arm on a joint at 0 rad with the target 1 rad, and a script on its base."""
    file = write_ttt(folder / "arm.ttt", arm(0, control, 1), script(10, lua))
    run = run_sim(file, "--no-ros", "--speed", "max", "--until", until, "--strict")
    assert run.returncode == 0, run.stderr
    assert "controlled by a callback" not in run.stderr
    return run.stdout.splitlines()


def test_a_joint_of_a_file_in_callback_mode_is_driven_by_its_base_s_script(tmp_path: Path) -> None:
    lua = """
        function sysCall_init() motor = sim.getObject('./motor') end
        function sysCall_joint(inData)
            assert(inData.handle == motor and inData.revolute and not inData.cyclic)
            assert(inData.mode == sim.jointmode_dynamic)
            assert(math.abs(inData.lowLimit + 2) < 1e-6 and math.abs(inData.highLimit - 2) < 1e-6)
            assert(math.abs(inData.error - (inData.targetPos - inData.pos)) < 1e-9)
            assert(inData.first == (seen == nil))
            seen = true
            local ctrl = inData.error * 20
            if ctrl > inData.maxVel then ctrl = inData.maxVel end
            if ctrl < -inData.maxVel then ctrl = -inData.maxVel end
            return {vel = ctrl, force = inData.maxForce}
        end
        function sysCall_cleanup() print(string.format('%.2f', sim.getJointPosition(motor))) end
    """
    assert run_arm(tmp_path, lua, until=1) == ["1.00"]


def test_a_joint_in_another_mode_has_no_callback(tmp_path: Path) -> None:
    lua = """
        function sysCall_init() end
        function sysCall_joint(inData) print('called') end
    """
    assert run_arm(tmp_path, lua, until=0.1, control=4) == []


def test_a_callback_commands_a_force_by_a_velocity_out_of_reach(tmp_path: Path) -> None:
    lua = """
        function sysCall_init() motor = sim.getObject('./motor') end
        function sysCall_jointCallback(inData) return {velocity = 10000, force = 0.5} end
        function sysCall_cleanup() print(string.format('%.3f', sim.getJointVelocity(motor))) end
    """
    # 1 kg: a bar of 1 m by 0.05 m about its end has 1 / 3 + 0.05^2 / 12 kg m^2; for 0.1 s.
    assert run_arm(tmp_path, lua, until=0.1) == [f"{0.1 * 0.5 / (1 / 3 + 0.05**2 / 12):.3f}"]


def test_contact_callbacks_let_shapes_pass_through_each_other(tmp_path: Path) -> None:
    code = """
        def sysCall_init():
            self.floor = sim.getObject('/{floor}')
            self.pairs = set()
            sim.setObjectPosition(sim.handle_self, [0, 0, 0.3])
        def sysCall_contact(data):
            self.pairs.add(frozenset((data['handle1'], data['handle2'])))
            return {answer}
        def sysCall_cleanup():
            print(len(self.pairs), sim.getObjectPosition(sim.handle_self)[2] > 0)
    """
    floor = "Ground"
    for answer, expected in [
        ("None", "1 True"),
        ("{'ignoreContact': False}", "1 True"),
        ("{'ignoreContact': True}", "1 False"),
        ("{'collisionResponse': False}", "1 False"),
    ]:
        given = code.replace("{answer}", answer).replace("self.floor = sim.getObject('/{floor}')", "pass")
        assert floor
        assert lines(tmp_path, given, until=1) == [expected]


def test_objects_may_be_moved_in_a_contact_callback(tmp_path: Path) -> None:
    code = """
        def sysCall_init(): self.moved = False
        def sysCall_contactCallback(data):
            if not self.moved:
                self.moved = True
                sim.setObjectPosition(sim.handle_self, [0, 0, 20])
        def sysCall_cleanup(): print(self.moved, sim.getObjectPosition(sim.handle_self)[2] > 10)
    """
    assert lines(tmp_path, code, until=1) == ["True True"]


def test_a_callback_that_fails_in_a_substep_ends_its_script_only(tmp_path: Path) -> None:
    code = """
        def sysCall_init(): pass
        def sysCall_dyn(data):
            if sim.getSimulationTime() > 0.09: raise ValueError('broken')
    """
    run = run_script(tmp_path, code, until=0.5)
    assert run.stderr.count("ValueError: broken") == 1
    assert "failed in sysCall_dyn" in run.stderr
    assert run.returncode == 3


SONAR = """<sdf version="1.9"><world name="w">
  <physics type="ode"><max_step_size>0.005</max_step_size></physics>
  <model name="Eye"><static>true</static><link name="link">
    <sensor name="sonar" type="sonar"><update_rate>20</update_rate>
      <sonar><min>0.05</min><max>2</max><radius>0.5</radius></sonar></sensor></link></model>
  <model name="Wall"><static>true</static><pose>1.05 0 {height} 0 0 0</pose><link name="link">
    <collision name="c"><geometry><box><size>0.1 1 1</size></box></geometry></collision></link></model>
</world></sdf>"""


@pytest.mark.parametrize(("height", "expected"), [(0, ["triggered", "triggered"]), (50, [])])
def test_a_proximity_sensor_s_script_receives_what_it_detects(
    tmp_path: Path, height: float, expected: list[str]
) -> None:
    scene = write(tmp_path / "scene.sdf", SONAR.format(height=height))
    code = """
        def sysCall_init(): pass
        def sysCall_trigger(data):
            result, distance, point, detected, normal = sim.readProximitySensor(data['handle'])
            assert result == 1 and data['detectedObjectHandle'] == detected
            assert data['detectedPoint'] == point and data['normalVector'] == normal
            print('triggered')
            return {'trigger': True}
    """
    file = write(tmp_path / "script.py", code)
    options = ["--no-ros", "--speed", "max", "--until", 0.1, "--child-script", f"/Eye/link/sonar={file}"]
    run = run_sim(scene, *options)
    assert (without_slowness(run.stderr), run.returncode) == ("", 0)
    assert run.stdout.splitlines() == expected


def test_scripts_for_the_run_as_a_whole_begin_first_and_end_last(tmp_path: Path) -> None:
    around = """
        def sysCall_init(): print('init of the first')
        def sysCall_beforeSimulation(): print('before')
        def sysCall_afterSimulation(): print('after')
        def sysCall_cleanup(): print('cleanup of the first')
    """
    other = """
        def sysCall_init(): print('init of the other')
        def sysCall_cleanup(): print('cleanup of the other')
    """
    first, second = write(tmp_path / "first.py", around), write(tmp_path / "second.py", other)
    scene = write(tmp_path / "scene.sdf", SONAR.format(height=0))
    options = ["--no-ros", "--speed", "max", "--until", 0.05]
    run = run_sim(scene, *options, "--child-script", f"/Wall={first}", "--child-script", f"/Eye={second}")
    assert run.stdout.splitlines() == [
        "init of the first",
        "before",
        "init of the other",
        "cleanup of the other",
        "after",
        "cleanup of the first",
    ]


def test_contact_callbacks_give_pairs_of_shapes_their_friction(tmp_path: Path) -> None:
    code = """
        function sysCall_init()
            boxes = {}
            for i, mu in ipairs{0.2, 0.5} do
                local box = sim.createPureShape(0, 8, {0.2, 0.2, 0.1}, 1)
                sim.setObjectPosition(box, -1, {-2, 2 * i, 0.05})
                sim.setObjectFloatParam(box, sim.shapefloatparam_init_velocity_x, 2)
                boxes[box] = mu
            end
        end
        function sysCall_contact(data)
            local mu = boxes[data.handle1] or boxes[data.handle2]
            if mu then return {ignoreContact = false, collisionResponse = true, mu = mu, mu2 = mu} end
        end
        function sysCall_cleanup()
            for box, mu in pairs(boxes) do print(mu, sim.getObjectPosition(box, -1)[1] + 2) end
        end
    """
    run = run_script(tmp_path, code, "--strict", name="script.lua", scene="p3dx_floor", target="/Floor", until=2.0)
    assert run.stderr == ""
    for line in run.stdout.splitlines():
        mu, way = map(float, line.split())
        assert way == pytest.approx(2**2 / (2 * mu * 9.81), rel=0.03)  # v^2 / (2 mu g)
    assert len(run.stdout.splitlines()) == 2
