# SPDX-License-Identifier: BSD-3-Clause
"""Functions of `sim` that push models and command forces of joints, with CoppeliaSim's conventions."""

from pathlib import Path

import pytest

from node_support import run_script, write

# Bodies of 2 kg; the model's frame is turned by a quarter about z. The wheel is free and turns about z.
SCENE = """\
<?xml version="1.0"?>
<sdf version="1.9" xmlns:bubblesim="bubblesim">
  <world name="w">
    <gravity>0 0 0</gravity>
    <model name="Body">
      <pose>0 0 0 0 0 1.5707963267948966</pose>
      <link name="link"><inertial><mass>2</mass>
        <inertia><ixx>1</ixx><iyy>1</iyy><izz>1</izz></inertia></inertial></link>
    </model>
    <model name="Wheel">
      <link name="rim"/>
      <joint name="axle" type="continuous"><parent>world</parent><child>rim</child>
        <axis><xyz>0 0 1</xyz><limit><effort>5</effort></limit><bubblesim:motor>velocity</bubblesim:motor></axis>
      </joint>
    </model>
  </world>
</sdf>
"""


def run(folder: Path, code: str, *options: object, name: str = "script.py") -> str:
    scene = str(write(folder / "scene.sdf", SCENE))
    done = run_script(folder, code, "--strict", *options, name=name, scene=scene, target="/Body", until=0.15)
    assert (done.stderr, done.returncode) == ("", 0)
    return done.stdout


def test_a_force_is_in_the_frame_of_the_object_and_acts_for_one_step(tmp_path: Path) -> None:
    code = """
        def sysCall_init():
            self.link = sim.getObject('/Body/link')
            sim.addForce(self.link, [0, 0, 0], [4, 0, 0])
        def sysCall_sensing():
            print(*[round(x, 9) for x in sim.getObjectVelocity(self.link)[0]])
    """
    assert run(tmp_path, code).split("\n")[:3] == ["0.0 0.1 0.0"] * 3  # the object's x is the world's y


def test_a_force_beside_the_centre_turns(tmp_path: Path) -> None:
    code = """
        def sysCall_init():
            self.link = sim.getObject('.')
            sim.addForce(self.link, [0, 0.5, 0], [4, 0, 0])
        def sysCall_sensing():
            print(round(sim.getObjectVelocity(self.link)[1][2], 6))
    """
    assert run(tmp_path, code).split()[0] == "-0.1"  # 2 N m during 0.05 s


def test_forces_and_torques_are_in_world_axes_and_add_up(tmp_path: Path) -> None:
    code = """
        def sysCall_init():
            self.body = sim.getObject('.')
            sim.addForceAndTorque(self.body, [1, 0, 0], [0, 0, 1])
            sim.addForceAndTorque(self.body, [3, 0, 0])
            sim.addForceAndTorque(self.body, None, [0, 0, 1])
        def sysCall_sensing():
            linear, angular = sim.getObjectVelocity(self.body)
            print(round(linear[0], 9), round(angular[2], 6))
    """
    assert run(tmp_path, code).split("\n")[0] == "0.1 0.1"


def test_flags_remove_what_was_added_before(tmp_path: Path) -> None:
    code = """
        def sysCall_init():
            self.body = sim.getObject('.')
            sim.addForceAndTorque(self.body, [8, 0, 0], [0, 0, 1])
            sim.addForceAndTorque(self.body + sim.handleflag_resetforce, [4, 0, 0])
        def sysCall_sensing():
            linear, angular = sim.getObjectVelocity(self.body)
            print(round(linear[0], 9), round(angular[2], 6))
    """
    assert run(tmp_path, code).split("\n")[0] == "0.1 0.05"


PYTHON = """
    def sysCall_init():
        self.axle = sim.getObject('/axle')
        sim.setObjectInt32Param(self.axle, sim.jointintparam_dynctrlmode, sim.jointdynctrl_force)
        assert sim.getObjectInt32Param(self.axle, sim.jointintparam_dynctrlmode) == sim.jointdynctrl_force
        sim.setJointTargetForce(self.axle, -2)
        assert sim.getJointTargetForce(self.axle) == -2
        sim.addForceAndTorque(sim.getObject('.'), [4, 0, 0], [0, 0, 0])
    def sysCall_sensing():
        print('%.4f' % sim.getJointVelocity(self.axle), '%.4f' % sim.getJointForce(self.axle))
"""
LUA = """
    function sysCall_init()
      axle = sim.getObject('/axle')
      sim.setObjectInt32Param(axle, sim.jointintparam_dynctrlmode, sim.jointdynctrl_force)
      assert(sim.getObjectInt32Param(axle, sim.jointintparam_dynctrlmode) == sim.jointdynctrl_force)
      sim.setJointTargetForce(axle, -2)
      assert(sim.getJointTargetForce(axle) == -2)
      sim.addForceAndTorque(sim.getObject('.'), {4, 0, 0}, {0, 0, 0})
    end
    function sysCall_sensing()
      print(string.format('%.4f %.4f', sim.getJointVelocity(axle), sim.getJointForce(axle)))
    end
"""


@pytest.mark.parametrize(("name", "code"), [("script.py", PYTHON), ("script.lua", LUA)])
def test_a_joint_in_force_mode_exerts_its_target_force(tmp_path: Path, name: str, code: str) -> None:
    assert run(tmp_path, code, name=name).split("\n")[:2] == ["-0.1000 -2.0000", "-0.2000 -2.0000"]


def test_an_unsigned_force_has_the_direction_of_the_target_velocity(tmp_path: Path) -> None:
    code = """
        def sysCall_init():
            axle = sim.getObject('/axle')
            sim.setJointTargetVelocity(axle, -1)
            sim.setJointTargetForce(axle, -3)
            assert sim.getJointTargetForce(axle) == 3  # the limit of a velocity motor
            sim.setObjectInt32Param(axle, sim.jointintparam_dynctrlmode, sim.jointdynctrl_force)
            sim.setJointTargetForce(axle, 2, False)
            assert sim.getJointTargetForce(axle) == -2
    """
    run(tmp_path, code)


@pytest.mark.parametrize(
    ("call", "message"),
    [
        ("sim.addForce(sim.getObject('/axle'), [0, 0, 0], [1, 0, 0])", "a wrench acts on a link or a model"),
        ("sim.addForce(sim.getObject('.'), [0, 0, 0], [1, 0])", "3 numbers"),
        ("sim.addForceAndTorque(sim.getObject('.'), [float('nan'), 0, 0])", "must be finite"),
        ("sim.setObjectInt32Param(sim.getObject('/axle'), 2039, 12)", "12 is not a control mode"),
        ("sim.setObjectInt32Param(sim.getObject('/axle'), 1, 0)", "there is no parameter 1"),
        ("sim.setObjectInt32Param(sim.getObject('.'), 2039, 1)", "not a joint"),
    ],
)
def test_wrong_calls_name_what_is_wrong(tmp_path: Path, call: str, message: str) -> None:
    scene = str(write(tmp_path / "scene.sdf", SCENE))
    done = run_script(tmp_path, f"def sysCall_init(): {call}\n", scene=scene, target="/Body")
    assert message in done.stderr
