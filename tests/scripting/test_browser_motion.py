# SPDX-License-Identifier: BSD-3-Clause
"""Models of CoppeliaSim's browser move as they should: on wheels, in the air and on foot."""

import math
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from browser_support import placed, script
from node_support import in_init, run_script
from ros_support import REPOSITORY


@pytest.mark.parametrize("name", ["ePuck", "LineTracer", "bubbleRob", "dr12", "dr20", "Kilobot", "youBot", "Bill"])
def test_a_model_stands_still(name: str) -> None:
    simulation = placed(name)
    base = simulation.object(f"/{name}")
    simulation.step(10)
    before = np.array([*base.position, *base.orientation])
    simulation.step(60)
    assert np.array([*base.position, *base.orientation]) == pytest.approx(before, abs=5e-4)
    assert base.orientation == pytest.approx([0, 0, 0, 1], abs=0.02)


WHEELS = {  # motors, their speed in rad/s, radius and distance of the wheels and place of their axle in m
    "ePuck": (("leftJoint", "rightJoint"), 4.0, 0.0205, 0.053, 0.0),
    "LineTracer": (("DynamicLeftJoint", "DynamicRightJoint"), 5.0, 0.027, 0.119, 0.0),
    "bubbleRob": (("leftMotor", "rightMotor"), 3.0, 0.04, 0.2, 0.05),
    "dr12": (("leftJoint_", "rightJoint_"), 4.0, 0.0425, 0.17, 0.0),
    "dr20": (("leftWheelJoint_", "rightWheelJoint_"), 4.0, 0.0425, 0.254, 0.0),
    "Kilobot": (("Revolute_jointLeftLeg", "Revolute_jointRightLeg"), 2.0, 0.005, 0.025, 0.0),
}


@pytest.mark.parametrize("name", WHEELS)
@pytest.mark.parametrize(("left", "right"), [(1, 1), (-1, -1), (0.5, 1), (-1, 1)])
def test_wheels_drive_a_robot_as_their_radius_and_distance_require(name: str, left: float, right: float) -> None:
    motors, speed, radius, track, ahead = WHEELS[name]
    simulation = placed(name)
    base = simulation.object(f"/{name}")
    for motor, share in zip(motors, (left, right), strict=True):
        simulation.object(f"/{name}/{motor}").target_velocity = share * speed
    simulation.step(20)
    way = turned = 0.0
    x, y, heading = axle(base, ahead)
    for _ in range(40):
        simulation.step(1)
        before = x, y, heading
        x, y, heading = axle(base, ahead)
        way += math.dist(before[:2], (x, y))
        turned += math.remainder(heading - before[2], math.tau)
    rim = speed * radius
    assert turned / 2 == pytest.approx(rim * (right - left) / track, rel=0.01, abs=0.002)
    assert way / 2 == pytest.approx(rim * abs(left + right) / 2, rel=0.01, abs=0.002)


def axle(base: Any, ahead: float) -> tuple[float, float, float]:
    """The place of a robot's axle, so far ahead of its origin, and its heading."""
    x, y, z, w = base.orientation
    heading = math.atan2(2 * (w * z + x * y), 1 - 2 * (y * y + z * z))
    return base.position[0] + ahead * math.cos(heading), base.position[1] + ahead * math.sin(heading), heading


def test_the_line_tracer_follows_a_dark_ring(tmp_path: Path) -> None:
    piece = (
        '<visual name="{i}"><pose>{x} {y} 0.001 0 0 {a}</pose>'
        "<geometry><box><size>0.06 0.03 0.002</size></box></geometry>"
        "<material><diffuse>0 0 0 1</diffuse></material></visual>"
    )
    angles = [math.tau * i / 90 for i in range(90)]
    ring = "".join(piece.format(i=i, x=0.5 * math.sin(a), y=0.5 - 0.5 * math.cos(a), a=a) for i, a in enumerate(angles))
    board = (
        '<model name="board"><static>true</static><link name="link"><visual name="white"><geometry><box>'
        "<size>3 3 0.0005</size></box></geometry><material><diffuse>1 1 1 1</diffuse></material></visual>"
        f"{ring}</link></model>"
    )
    (tmp_path / "ring.sdf").write_text(f'<sdf version="1.9">{board}</sdf>')
    body = """
sim.removeModel(sim.getObject('/PioneerP3DX'))
sim.loadModel('ring')
self.robot, self.places = sim.loadModel('line tracer.ttm'), []
"""
    rest = """
def sysCall_sensing():
    self.places.append(sim.getObjectPosition(self.robot))
def sysCall_cleanup():
    assert all(abs(math.hypot(x, y - 0.5) - 0.5) < 0.05 for x, y, _ in self.places), self.places[::40]
    assert any(y > 0.9 for _, y, _ in self.places)
"""
    (tmp_path / "models" / "ring").mkdir(parents=True)
    (tmp_path / "ring.sdf").rename(tmp_path / "models" / "ring" / "model.sdf")
    (tmp_path / "floor.sdf").write_text((REPOSITORY / "scenes" / "p3dx_floor.sdf").read_text())
    code = f"import math\n{in_init(body)}{rest}"
    run = run_script(tmp_path, code, "--strict", scene=str(tmp_path / "floor.sdf"), target="/Floor", until=40)
    assert (run.stderr, run.returncode) == ("", 0)


def test_the_quadcopter_flies_to_its_target(tmp_path: Path) -> None:
    body = """
self.copter = sim.loadModel('Quadcopter.ttm')
self.target = sim.getObject('/Quadcopter/target')
sim.setObjectPosition(self.copter, [1, 1, 0.51])
sim.setObjectPosition(self.target, [2, 1.5, 1.2])
sim.setObjectOrientation(self.target, [0, 0, 1])
"""
    rest = """
def sysCall_cleanup():
    assert math.dist(sim.getObjectPosition(self.copter), [2, 1.5, 1.2]) < 0.01, sim.getObjectPosition(self.copter)
    roll, pitch, heading = sim.getObjectOrientation(self.copter)
    assert abs(roll) + abs(pitch) + abs(heading - 1) < 0.02
"""
    script(tmp_path, body, rest=rest, until=10)


def test_the_conveyor_moves_what_lies_on_it_at_the_speed_of_its_belt(tmp_path: Path) -> None:
    body = """
sim.removeModel(sim.getObject('/PioneerP3DX'))
self.conveyor = sim.loadModel('models/equipment/conveyor belts/conveyor.ttm')
sim.setObjectPosition(self.conveyor, [1, 2, 0])
self.box = sim.createPureShape(0, 8, [0.1, 0.1, 0.1], 0.5)
sim.setObjectPosition(self.box, [0.6, 2, 0.33])
self.places = []
"""
    rest = """
def sysCall_actuation():
    if abs(sim.getSimulationTime() - 2) < 0.01:
        sim.writeCustomTableData(self.conveyor, '__ctrl__', {'vel': 0.3})

def sysCall_sensing():
    self.places.append(sim.getObjectPosition(self.box))

def sysCall_cleanup():
    assert abs(self.places[35][0] - self.places[15][0] - 0.1) < 1e-3, self.places[::5]
    assert abs(self.places[55][0] - self.places[45][0] - 0.15) < 1e-3, self.places[::5]
    assert max(abs(y - 2) for _, y, _ in self.places) < 1e-3 and self.places[55][2] > 0.32
    assert abs(sim.readCustomTableData(self.conveyor, '__state__')['vel'] - 0.3) < 1e-9
    assert math.dist(sim.getObjectPosition(self.conveyor), [1, 2, 0]) < 1e-6
"""
    script(tmp_path, body, rest=rest, until=3)


def test_the_bumper_of_the_dr12_turns_it_away_from_a_wall(tmp_path: Path) -> None:
    body = """
sim.removeModel(sim.getObject('/PioneerP3DX'))
self.robot, wall = sim.loadModel('dr12.ttm'), sim.loadModel('80cmHighWall200cm.ttm')
sim.setObjectPosition(wall, [0.6, 0, 0.4])
sim.setObjectOrientation(wall, [0, 0, math.pi / 2])
self.places = []
"""
    rest = """
def sysCall_sensing():
    self.places.append((*sim.getObjectPosition(self.robot)[:2], sim.getObjectOrientation(self.robot)[2]))

def sysCall_cleanup():
    nearest = max(x for x, _, _ in self.places)
    last = self.places[-1]
    assert 0.6 - 0.05 - 0.13 < nearest < 0.6 - 0.05 - 0.11, nearest
    assert last[0] < nearest - 0.05 and abs(last[2]) > 0.3, last
"""
    script(tmp_path, body, rest=rest, until=4.8)


def test_the_youbot_drives_ahead_sideways_and_turns(tmp_path: Path) -> None:
    body = """
self.robot = sim.loadModel('KUKA YouBot.ttm')
sim.setObjectPosition(self.robot, [-2, -2, 0.05])
self.wheels = [sim.getObject(f'/youBot/rollingJoint_{name}') for name in ('fl', 'rl', 'rr', 'fr')]
self.poses = []
"""
    rest = """
def sysCall_actuation():
    ahead, right, clockwise = [(4, 0, 0), (0, 4, 0), (0, 0, 4)][min(2, int(sim.getSimulationTime() / 2))]
    signs = (-1, -1), (1, -1), (-1, 1), (1, 1)
    for wheel, (side, turn) in zip(self.wheels, signs):
        sim.setJointTargetVelocity(wheel, -ahead + side * right + turn * clockwise)

def sysCall_sensing():
    self.poses.append([*sim.getObjectPosition(self.robot)[:2], sim.getObjectOrientation(self.robot)[2]])

def sysCall_cleanup():
    for phase, wanted in enumerate(([0.2, 0, 0], [0, -0.2, 0], [0, 0, -0.2 / 0.386])):
        start, end = self.poses[20 + 40 * phase], self.poses[39 + 40 * phase]
        x, y, turned = [(b - a) / 0.95 for a, b in zip(start, end)]
        cos, sin = math.cos(start[2]), math.sin(start[2])
        speeds = cos * x + sin * y, cos * y - sin * x, turned
        assert all(abs(a - b) < 0.003 for a, b in zip(speeds, wanted)), (phase, speeds)
"""
    script(tmp_path, body, rest=rest, until=6)


def test_walking_bill_is_seen_and_goes_where_his_goal_is_put(tmp_path: Path) -> None:
    body = """
self.bill = sim.loadModel('models/people/Walking Bill.ttm')
sim.setObjectPosition(self.bill, [2, 2, 0])
self.goal = sim.getObject('/goalDummy')
self.sonar = sim.getObject('/PioneerP3DX/ultrasonicSensor[3]')
"""
    rest = """
def sysCall_sensing():
    if abs(sim.getSimulationTime() - 6) < 0.01:
        self.turned = sim.getObjectPosition(self.bill)[0] < 4 - 0.2
        sim.setObjectPosition(self.goal, [0.6, 0, 0])

def sysCall_cleanup():
    assert math.dist(sim.getObjectPosition(self.bill)[:2], [0.6, 0]) < 0.15, sim.getObjectPosition(self.bill)
    seen, distance, *_ = sim.readProximitySensor(self.sonar)
    assert seen and distance < 0.6 and self.turned
"""
    script(tmp_path, body, rest=rest, until=14)
