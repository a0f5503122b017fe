# SPDX-License-Identifier: BSD-3-Clause
"""Models that sim.loadModel finds by the names of CoppeliaSim's model browser: names, objects, scripts, motion."""

import math
from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt
import pytest

import bubblesim
from bubblesim.scripting.api.sim.browser_models import BROWSER_MODELS, PAGE, BrowserModel, browser_model
from node_support import REFUSED, in_init, run_script
from ros_support import REPOSITORY

Matrix = npt.NDArray[np.float64]

UR_JOINT, FRANKA_JOINT = "/joint/link" * 5 + "/joint", "/joint/link2_resp/joint/link3_resp/joint"
OBJECTS = {  # of the programs that people write for them
    "PioneerP3DX": "leftMotor rightMotor ultrasonicSensor[0] ultrasonicSensor[15]",
    "ePuck": "base leftJoint/leftRespondableWheel rightJoint/rightRespondableWheel proxSensor[0] proxSensor[7] "
    "lightSensor camera ledLight",
    "LineTracer": "DynamicLeftJoint DynamicRightJoint LeftSensor MiddleSensor RightSensor LineTracerBase",
    "bubbleRob": "leftMotor/leftWheel rightMotor/rightWheel sensingNose visionSensor connection/slider",
    "Quadcopter": "base target propeller[0]/respondable propeller[3]/joint floorCamera",
    "UR3": f"{UR_JOINT[1:]} connection link1_visible link7_visible",
    "UR5": f"{UR_JOINT[1:]} link/joint connection link7_visible",
    "UR10": f"{UR_JOINT[1:]} connection link7_visible",
    "Franka": f"{FRANKA_JOINT[1:]} link2_resp/joint link8_resp/connection FrankaGripper/openCloseJoint "
    "FrankaGripper/attachProxSensor",
    "RG2": "openCloseJoint attachPoint attachProxSensor",
    "youBot": "rollingJoint_fl rollingJoint_rl rollingJoint_rr rollingJoint_fr "
    "youBotArmJoint0/youBotArmJoint1/youBotArmJoint2 youBotArmJoint4 youBotGripperJoint1 youBotGripperJoint2",
    "Bill": "goalDummy leftLegJoint rightKneeJoint leftAnkleJoint rightShoulderJoint leftElbowJoint rightHand_tip neck",
}
FILES = [(file, model.object) for model in BROWSER_MODELS for file in model.files]


def placed(model_object: str, height: float = 0.0) -> bubblesim.Simulation:
    """A simulation of a floor, and of a model this far above it, without its script."""
    simulation = bubblesim.Simulation("p3dx_floor")
    simulation.remove_model(simulation.object("/PioneerP3DX").handle)
    model = next(each for each in BROWSER_MODELS if each.object == model_object)
    simulation.add_model(model.text(), name=model_object, position=[0, 0, height])
    return simulation


def script(folder: Path, body: str, *options: object, rest: str = "", until: float = 0.2) -> str:
    """Run `body` in sysCall_init of a script of the floor; an error fails the test. Return what it printed."""
    code = f"import math\n{REFUSED}{in_init(body)}{rest}"
    run = run_script(folder, code, "--strict", *options, scene="p3dx_floor", target="/Floor", until=until)
    assert (run.stderr, run.returncode) == ("", 0)
    return run.stdout


def test_a_script_loads_each_file_of_the_browser_by_any_path(tmp_path: Path) -> None:
    body = f"""
for file, name in {FILES}:
    old = file.upper().replace(' ', '_')
    for path in (f'./models/some folder/{{file}}.ttm', f'C:\\\\Program Files\\\\models\\\\{{old}}.ttm'):
        model = sim.loadModel(path)
        assert sim.getObjectAlias(model) in (name, name + '_2'), (path, sim.getObjectAlias(model))
        sim.removeModel(model)
"""
    script(tmp_path, body)


def test_the_objects_have_the_names_that_programs_use(tmp_path: Path) -> None:
    files = {model.object: model.files[0] for model in reversed(BROWSER_MODELS)}
    body = f"""
sim.removeModel(sim.getObject('/PioneerP3DX'))
for name, parts in {OBJECTS}.items():
    model = sim.loadModel({files}[name] + '.ttm')
    assert sim.getObject('/' + name) == model and sim.getModelProperty(model) == 0
    for part in parts.split():
        assert sim.isHandle(sim.getObject(f'/{{name}}/{{part}}')), part
    sim.removeModel(model)
"""
    script(tmp_path, body)


def test_an_unknown_name_is_an_error_with_the_nearest_one(tmp_path: Path) -> None:
    body = """
error = refused(sim.loadModel, 'models/robots/mobile/pionier p3dx.ttm')
assert "there is no model 'pionier p3dx'" in error
assert "did you mean 'pioneer p3dx'?" in error
assert 'docs/models_of_the_browser.md lists' in error
"""
    script(tmp_path, body)


def test_a_file_beside_the_scene_comes_first(tmp_path: Path) -> None:
    text = '<sdf version="1.9"><model name="own"><static>true</static><link name="only"/></model></sdf>'
    (tmp_path / "line tracer.sdf").write_text(text)
    floor = '<sdf version="1.9"><world name="w"><include><uri>model://floor</uri></include></world></sdf>'
    (tmp_path / "scene.sdf").write_text(floor)
    code = in_init("model = sim.loadModel('line tracer.ttm')\nassert sim.getObject('./only', {'proxy': model}) > 0")
    run = run_script(tmp_path, code, "--strict", scene=str(tmp_path / "scene.sdf"), target="/Floor")
    assert (run.stderr, run.returncode) == ("", 0)


def test_the_scripts_of_all_models_run_for_ten_seconds(tmp_path: Path) -> None:
    files = [model.files[0] for model in BROWSER_MODELS if isinstance(model, BrowserModel)]
    body = f"""
for i, file in enumerate({files}):
    model = sim.loadModel(file + '.ttm')
    x, y, z = sim.getObjectPosition(model)
    sim.setObjectPosition(model, [3 * (i % 4) - 4, 3 * (i // 4) - 6, z])
"""
    script(tmp_path, body, until=10)


def test_old_names_find_the_parts(tmp_path: Path) -> None:
    body = """
for file in ('e-puck', 'Quadricopter', 'UR5', 'KUKA YouBot', 'Standing Bill'):
    sim.loadModel(file + '.ttm')
old_names = 'ePuck_leftJoint ePuck_proxSensor8 Quadricopter_target UR5_joint6 rollingJoint_fl Bill_goalDummy'
for name in old_names.split():
    assert sim.isHandle(sim.getObjectHandle(name))
"""
    script(tmp_path, body)


@pytest.mark.parametrize("name", ["ePuck", "LineTracer", "bubbleRob", "youBot", "Bill"])
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


def test_the_page_lists_each_model_with_its_object() -> None:
    rows = [line for line in (REPOSITORY / PAGE).read_text().splitlines() if line.startswith("| `")]
    listed = {file for row in rows for file in row.split("|")[1].replace("`", "").strip().split(", ")}
    for model in BROWSER_MODELS:
        if isinstance(model, BrowserModel):
            row = next(row for row in rows if f"`{model.files[0]}`" in row)
            assert f"`/{model.object}`" in row
            assert set(model.files) <= listed


def test_a_name_of_the_table_stands_for_one_model() -> None:
    assert len({file for file, _ in FILES}) == len(FILES)
    assert all(browser_model(f"models/{file}.ttm") is not None for file, _ in FILES)
