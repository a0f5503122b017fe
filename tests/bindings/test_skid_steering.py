# SPDX-License-Identifier: BSD-3-Clause
"""Wide cylinders as wheels of a robot with skid steering: where they bear their load, and how fast it turns."""

import math
from pathlib import Path

import pytest

import bubblesim
from bubblesim import MotorMode

TRACK, BASE, RADIUS, WIDTH = 0.57, 0.51, 0.165, 0.11  # m
RIM_SPEED = 0.43  # m/s
MASS, WHEEL_MASS = 46.0, 2.6  # kg
LEVER = 0.069  # m, of the centre of mass to the right
CORNERS = {"fl": (1, 1), "fr": (1, -1), "rl": (-1, 1), "rr": (-1, -1)}

WHEEL = """<link name="{name}"><pose>{x} {y} 0.165 1.5707963 0 0</pose>
  <inertial><mass>2.6</mass><inertia><ixx>0.025</ixx><iyy>0.025</iyy><izz>0.044</izz></inertia></inertial>
  <collision name="c"><geometry><cylinder><radius>0.165</radius><length>0.11</length></cylinder></geometry>
    <surface><friction><ode><mu>1</mu></ode></friction>
      <contact><ode><kp>1e7</kp><kd>1</kd></ode></contact></surface></collision></link>
<joint name="{name}_axle" type="revolute"><parent>base</parent><child>{name}</child>
  <axis><xyz expressed_in="base">0 1 0</xyz></axis></joint>"""
ROBOT = """<sdf version="1.9"><world name="w"><physics type="ode"><max_step_size>0.001</max_step_size></physics>
<model name="ground"><static>true</static><link name="l"><collision name="c"><geometry><plane/></geometry></collision>
</link></model>
<model name="robot"><link name="base"><pose>0 0 0.2 0 0 0</pose><inertial><pose>0 {shift} 0 0 0 0</pose><mass>46</mass>
  <inertia><ixx>0.6</ixx><iyy>1.7</iyy><izz>2</izz></inertia></inertial></link>WHEELS</model></world></sdf>"""


def rate_without_torque(loads: tuple[float, float]) -> float:
    """Return the yaw rate at which Coulomb's forces of the left and right wheels have no sum and no torque, rad/s.

    It goes along x with v meanwhile; by symmetry of front and rear, the sideways forces cancel. Bisection in both.
    """

    def along(v: float, rate: float, side: int) -> float:
        slip = v - side * rate * TRACK / 2 + side * RIM_SPEED
        return slip / math.hypot(slip, rate * BASE / 2)

    def speed(rate: float) -> float:
        low, high = -RIM_SPEED, RIM_SPEED
        for _ in range(60):
            middle = (low + high) / 2
            total = loads[0] * along(middle, rate, 1) + loads[1] * along(middle, rate, -1)
            low, high = (low, middle) if total > 0 else (middle, high)
        return low

    def torque(rate: float) -> float:
        v, total = speed(rate), 0.0
        for side, load in ((1, loads[0]), (-1, loads[1])):
            slip = v - side * rate * TRACK / 2 + side * RIM_SPEED
            forward = slip / math.hypot(slip, rate * BASE / 2)
            sideways = rate * BASE / 2 / math.hypot(slip, rate * BASE / 2)
            total += load * (side * TRACK / 2 * forward - BASE / 2 * sideways)
        return total

    low, high = 1e-6, 2 * RIM_SPEED / TRACK
    for _ in range(60):
        middle = (low + high) / 2
        low, high = (middle, high) if torque(middle) > 0 else (low, middle)
    return low


def turning(tmp_path: Path, shift: float) -> tuple[bubblesim.Simulation, float]:
    """Return the simulation after 4 s of turning, and the rate of the last second."""
    wheels = "".join(
        WHEEL.format(name=name, x=along * BASE / 2, y=across * TRACK / 2) for name, (along, across) in CORNERS.items()
    )
    file = tmp_path / "robot.sdf"
    file.write_text(ROBOT.format(shift=shift).replace("WHEELS", wheels))
    simulation = bubblesim.Simulation(str(file))
    world = simulation.world
    for name, (_, across) in CORNERS.items():
        axle = world.find(f"/robot/{name}_axle")
        world.set_motor_mode(axle, MotorMode.VELOCITY)
        world.set_target_velocity(axle, -across * RIM_SPEED / RADIUS)
    for _ in range(60):
        simulation.step()
    base, rates = world.find("/robot/base"), []
    for _ in range(20):
        simulation.step()
        rates.append(world.velocity(base)[1][2])
    return simulation, sum(rates) / len(rates)


@pytest.mark.parametrize("lever", [0.0, LEVER])
def test_a_robot_turns_as_fast_as_friction_lets_it(tmp_path: Path, lever: float) -> None:
    _, rate = turning(tmp_path, -lever * (MASS + 4 * WHEEL_MASS) / MASS)
    right = 0.5 + lever / TRACK
    assert rate == pytest.approx(rate_without_torque((1 - right, right)), rel=0.03)
    if lever == 0.0:
        assert rate == pytest.approx(2 * TRACK * RIM_SPEED / (TRACK**2 + BASE**2), rel=0.03)


def test_wheels_bear_their_load_along_their_width(tmp_path: Path) -> None:
    simulation, _ = turning(tmp_path, -LEVER)
    loads = [load for *_, load in simulation.world.contact_points()]
    assert len(loads) == 8, "two ends of each wheel"
    assert min(loads) > 0.2 * max(loads)
