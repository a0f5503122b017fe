# SPDX-License-Identifier: BSD-3-Clause
"""Joint motors, compared with weights, levers and moments of inertia."""

from collections.abc import Callable
from pathlib import Path

import pytest

import bubblesim
from node_support import run_script, write

G = 9.8  # m/s^2, SDFormat's default
MASS = 3.0
LENGTH = 0.5
INERTIA = 0.04  # kg m^2, about the centre of mass


def arm(folder: Path, joint: str, axis: str, *, below: str = "", gravity: float = -G) -> Path:
    """Write a mass half a metre along x from a joint at the origin, and other elements of the model."""
    return write(
        folder / "arm.sdf",
        f"""\
        <?xml version="1.0"?>
        <sdf version="1.9" xmlns:bubblesim="bubblesim"><world name="w">
          <gravity>0 0 {gravity}</gravity>
          <model name="Arm">
            <link name="arm">
              <inertial><pose>{LENGTH} 0 0 0 0 0</pose><mass>{MASS}</mass>
                <inertia><ixx>{INERTIA}</ixx><iyy>{INERTIA}</iyy><izz>{INERTIA}</izz></inertia></inertial>
            </link>
            <joint name="joint" type="{joint}"><parent>world</parent><child>arm</child>{axis}</joint>
            {below}
          </model>
        </world></sdf>""",
    )


def axis(direction: str, motor: str, limits: str = "", *, number: str = "") -> str:
    driven = f"<bubblesim:motor>{motor}</bubblesim:motor>" if motor else ""
    return f"<axis{number}><xyz>{direction}</xyz><limit>{limits}</limit>{driven}</axis{number}>"


def motor_effort(file: Path, *, steps: int = 40, axis: int = 0, target_velocity: float = 0.0) -> float:
    simulation = bubblesim.Simulation(str(file))
    joint = simulation.object("/joint").handle
    simulation.world.set_target_velocity(joint, target_velocity, axis)
    simulation.step(steps)
    return float(simulation.world.motor_effort(joint, axis))


@pytest.mark.parametrize("motor", ["velocity", "position"])
@pytest.mark.parametrize("limits", ["", "<lower>-1</lower><upper>1</upper>"], ids=["no limits", "limits"])
def test_a_pendulum_is_held_by_its_weight_times_its_lever(tmp_path: Path, motor: str, limits: str) -> None:
    # Gravity turns the mass at +x about +y.
    file = arm(tmp_path, "revolute", axis("0 1 0", motor, limits))
    assert motor_effort(file) == pytest.approx(-MASS * G * LENGTH, rel=1e-3)


def test_a_lift_is_held_by_its_weight(tmp_path: Path) -> None:
    assert motor_effort(arm(tmp_path, "prismatic", axis("0 0 1", "velocity"))) == pytest.approx(MASS * G, rel=1e-3)


def test_a_motor_at_its_limit_does_what_it_may(tmp_path: Path) -> None:
    axis_ = axis("0 0 1", "velocity", "<effort>0.3</effort>")
    file = arm(tmp_path, "revolute", axis_)
    assert motor_effort(file, steps=5, target_velocity=100) == pytest.approx(0.3, rel=1e-5)


def test_what_accelerates_takes_its_inertia(tmp_path: Path) -> None:
    file = arm(tmp_path, "revolute", axis("0 0 1", "velocity"))
    speed = 2.0
    mean = (INERTIA + MASS * LENGTH**2) * speed / 0.05  # it reaches its speed in the first step
    assert motor_effort(file, steps=1, target_velocity=speed) == pytest.approx(mean, rel=1e-3)


def test_a_stop_is_no_motor(tmp_path: Path) -> None:
    file = arm(tmp_path, "revolute", axis("0 1 0", "velocity", "<lower>-1</lower><upper>0</upper><effort>0.2</effort>"))
    assert abs(motor_effort(file)) < 0.2001  # the joint limit carries the rest of 14.7 N m


def test_an_axis_without_a_motor_does_nothing(tmp_path: Path) -> None:
    assert motor_effort(arm(tmp_path, "revolute", axis("0 1 0", ""))) == pytest.approx(0, abs=1e-3)


@pytest.mark.parametrize(("first", "second"), [("0 1 0", "0 0 1"), ("0 0 1", "0 1 0")])
def test_each_of_two_axes_has_its_own(tmp_path: Path, first: str, second: str) -> None:
    file = arm(tmp_path, "universal", axis(first, "velocity") + axis(second, "velocity", number="2"))
    forces = [motor_effort(file, axis=index) for index in (0, 1)]
    wanted = [-MASS * G * LENGTH if direction == "0 1 0" else 0 for direction in (first, second)]
    assert forces == pytest.approx(wanted, rel=1e-3, abs=1e-3)


def test_it_agrees_with_a_sensor_of_the_joint(tmp_path: Path) -> None:
    sensed = axis("0 1 0", "velocity") + '<sensor name="Force" type="force_torque"/>'
    simulation = bubblesim.Simulation(str(arm(tmp_path, "revolute", sensed)))
    joint = simulation.object("/joint")
    simulation.step(3)
    assert simulation.object("/Force").reading.torque[1] == pytest.approx(-simulation.world.motor_effort(joint.handle))


def test_it_is_known_in_the_first_step(tmp_path: Path) -> None:
    file = arm(tmp_path, "prismatic", axis("0 0 1", "velocity"))
    assert motor_effort(file, steps=1) == pytest.approx(MASS * G, rel=1e-3)


def without_force(joint: bubblesim.Object) -> None:
    joint.max_force = 0.0


def without_mode(joint: bubblesim.Object) -> None:
    joint.motor_mode = bubblesim.MotorMode.NONE


@pytest.mark.parametrize("switch_off", [without_force, without_mode])
def test_a_motor_switched_off_exerts_nothing(tmp_path: Path, switch_off: Callable[[bubblesim.Object], None]) -> None:
    limited = axis("0 0 1", "velocity", "<lower>-100</lower><upper>100</upper>")
    sensed = limited + '<sensor name="Force" type="force_torque"/>'
    simulation = bubblesim.Simulation(str(arm(tmp_path, "prismatic", sensed)))
    joint = simulation.object("/joint")
    simulation.step(3)
    assert joint.motor_effort == pytest.approx(MASS * G, rel=1e-3)
    switch_off(joint)
    simulation.step()
    assert joint.motor_effort == 0
    assert simulation.object("/Force").reading.force[2] == pytest.approx(0, abs=1e-6), "it falls freely"


def test_an_effort_motor_lifts_what_its_force_carries(tmp_path: Path) -> None:
    simulation = bubblesim.Simulation(str(arm(tmp_path, "prismatic", axis("0 0 1", "effort"))))
    joint = simulation.object("/joint")
    assert joint.motor_mode == bubblesim.MotorMode.EFFORT
    joint.target_effort = MASS * (G + 1.0)
    simulation.step(10)
    assert joint.joint_velocity == pytest.approx(0.5, abs=1e-6), "1 m/s^2 during 0.5 s"
    assert joint.motor_effort == pytest.approx(MASS * (G + 1.0))


def test_links_are_pushed(tmp_path: Path) -> None:
    simulation = bubblesim.Simulation(str(arm(tmp_path, "prismatic", axis("0 0 1", ""), gravity=0.0)))
    link = simulation.object("/arm")
    link.apply_wrench([0, 0, 6])
    link.apply_wrench([0, 0, 6], point=[0.1, 0, 0], local=True)
    simulation.world.apply_wrench(simulation.object("/Arm").handle, [0, 0, 3], torque=[0, 0, 1])
    simulation.step()
    assert link.linear_velocity[2] == pytest.approx(15 / MASS * 0.05)
    with pytest.raises(ValueError, match=r"the force .* must be finite"):
        link.apply_wrench([float("nan"), 0, 0])
    with pytest.raises(ValueError, match="force: expected 3 numbers"):
        link.apply_wrench([1, 2])
    with pytest.raises(bubblesim.WrongObject, match="acts on a link or a model"):
        simulation.object("/joint").apply_wrench([1, 0, 0])


PYTHON = """
    def sysCall_init(): self.joint = sim.getObject('/joint')
    def sysCall_sensing(): print(sim.getJointForce(self.joint))
"""
LUA = """
    function sysCall_init() joint = sim.getObject('/joint') end
    function sysCall_sensing() print(sim.getJointForce(joint)) end
"""


@pytest.mark.parametrize(("name", "code"), [("script.py", PYTHON), ("script.lua", LUA)])
def test_scripts_read_it(tmp_path: Path, name: str, code: str) -> None:
    scene = str(arm(tmp_path, "revolute", axis("0 1 0", "velocity")))
    run = run_script(tmp_path, code, "--strict", name=name, scene=scene, target="/Arm", until=0.5)
    assert run.stderr == ""
    forces = [float(line) for line in run.stdout.split()]
    assert forces == pytest.approx([-MASS * G * LENGTH] * 10, rel=1e-3)
