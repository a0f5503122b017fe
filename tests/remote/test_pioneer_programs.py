# SPDX-License-Identifier: BSD-3-Clause
"""Programs as people write them for CoppeliaSim's Pioneer drive ours: remote clients and child scripts, unchanged."""

import math
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt
import pytest

from node_support import run_script
from remote_support import RemoteNode

WHEEL_RADIUS = 0.195 / 2
TRACK = 0.331
EAST_WALL = 4.0  # x of its face
SONARS = [  # of the data sheet: forward, left (mm) and angle to the left (degrees)
    (69, 136, 90),
    (114, 119, 50),
    (148, 78, 30),
    (166, 27, 10),
    (166, -27, -10),
    (148, -78, -30),
    (114, -119, -50),
    (69, -136, -90),
    (-157, -136, -90),
    (-203, -119, -130),
    (-237, -78, -150),
    (-255, -27, -170),
    (-255, 27, 170),
    (-237, 78, 150),
    (-203, 119, 130),
    (-157, 136, 90),
]


@pytest.fixture
def room(tmp_path: Path) -> Iterator[Any]:
    with RemoteNode(tmp_path, "--speed", "max", scene="p3dx_room") as node:
        yield node.sim()


@pytest.fixture
def floor(tmp_path: Path) -> Iterator[Any]:
    with RemoteNode(tmp_path, "--speed", "max", scene="p3dx_floor") as node:
        yield node.sim()


def matrix_of(sim: Any, handle: int, frame: int = -1) -> npt.NDArray[np.float64]:
    """The pose of an object as a matrix of 3 rows and 4 columns."""
    return np.array(sim.getObjectMatrix(handle, frame)).reshape(3, 4)


def place(sim: Any, x: float, y: float, heading: float) -> None:
    robot = sim.getObject("/PioneerP3DX")
    sim.setObjectPosition(robot, [x, y, sim.getObjectPosition(robot)[2]])
    sim.setObjectOrientation(robot, [0, 0, heading])


class Braitenberg:
    """A vehicle that turns away from what its front sonars see."""

    NEAR, FAR = 0.2, 0.5  # m: full and no effect
    CRUISE = 2.0  # rad/s

    def __init__(self, sim: Any) -> None:
        self.sim = sim
        self.motors = [sim.getObject(f"/PioneerP3DX/{side}Motor") for side in ("left", "right")]
        self.sensors = [sim.getObject(f"/PioneerP3DX/ultrasonicSensor[{i}]") for i in range(16)]

    def act(self) -> list[float]:
        """Command the motors and return the distances of the front sonars."""
        seen = []
        left = right = self.CRUISE
        for i, sensor in enumerate(self.sensors[:8]):
            result, distance, *_ = self.sim.readProximitySensor(sensor)
            if not result or distance > self.FAR:
                continue
            seen.append(distance)
            effect = 1 - (max(distance, self.NEAR) - self.NEAR) / (self.FAR - self.NEAR)
            left -= 0.2 * (i + 1) * effect
            right -= 0.2 * (8 - i) * effect
        self.sim.setJointTargetVelocity(self.motors[0], left)
        self.sim.setJointTargetVelocity(self.motors[1], right)
        return seen


def test_a_braitenberg_vehicle_roams_the_room_without_touching_anything(room: Any) -> None:
    robot = room.getObject("/PioneerP3DX")
    vehicle = Braitenberg(room)
    room.setStepping(True)
    room.startSimulation()
    path, distances = [], []
    while room.getSimulationTime() < 60:
        distances += vehicle.act()
        room.step()
        path.append(room.getObjectPosition(robot, room.handle_world))
    room.stopSimulation()
    steps = np.linalg.norm(np.diff(np.array(path), axis=0), axis=1)
    assert steps.sum() > 6
    assert len(distances) > 20
    assert min(distances) > 0.05
    assert np.ptp(np.array(path)[:, 2]) < 0.01


def test_wheels_move_it_as_its_data_describe(floor: Any) -> None:
    robot, left, right = (floor.getObject(f"/PioneerP3DX{part}") for part in ("", "/leftMotor", "/rightMotor"))
    floor.setStepping(True)
    floor.startSimulation()
    speeds = np.array([2.0, 3.0])
    for motor, speed in zip((left, right), speeds, strict=True):
        floor.setJointTargetVelocity(motor, float(speed))
    places = []
    for _ in range(60):
        floor.step()
        places.append([*floor.getObjectPosition(robot, -1), floor.getObjectOrientation(robot, -1)[2]])
    found = (np.array(places[-1]) - places[19]) / 2  # per second
    turning = (speeds[1] - speeds[0]) * WHEEL_RADIUS / TRACK
    assert found[3] == pytest.approx(turning, rel=0.01)
    headings = np.array(places[19:])[:, 3]
    ahead = np.linalg.norm(np.diff(np.array(places[19:])[:, :2], axis=0), axis=1).sum() / 2
    assert ahead == pytest.approx(speeds.mean() * WHEEL_RADIUS, rel=0.01)
    assert headings[0] < headings[-1]
    assert floor.getJointVelocity(right) == pytest.approx(3.0, abs=0.02)
    assert floor.getObjectPosition(robot)[2] == pytest.approx(0.1388, abs=2e-3)
    linear, angular = floor.getObjectVelocity(robot)
    assert math.hypot(*linear[:2]) == pytest.approx(speeds.mean() * WHEEL_RADIUS, rel=0.02)
    assert angular[2] == pytest.approx(turning, rel=0.02)


def test_objects_have_the_names_and_types_of_the_original(room: Any) -> None:
    robot = room.getObject("/PioneerP3DX")
    sonars = room.getObjectsInTree(robot, room.object_proximitysensor_type)
    assert sonars == [room.getObject("/PioneerP3DX/ultrasonicSensor", {"index": i}) for i in range(16)]
    assert sonars[3] == room.getObject("/PioneerP3DX/ultrasonicSensor[3]")
    assert sonars[3] == room.getObject("./ultrasonicSensor[3]", {"proxy": robot})
    assert sonars[3] == room.getObject("./ultrasonicSensor[3]")  # of a client, which has no object of its own
    assert room.getObjectAlias(sonars[3]) == "ultrasonicSensor"
    assert room.getObjectAlias(sonars[3], 0) == "ultrasonicSensor[3]"
    assert room.getObject(room.getObjectAlias(sonars[3], 1)) == sonars[3]
    assert room.getObjectsInTree(robot, room.object_visionsensor_type) == [room.getObject("/PioneerP3DX/visionSensor")]
    wheels = ("leftWheel", "rightWheel", "caster_wheel", "caster_freeJoint1", "caster_freeJoint2")
    assert all(room.isHandle(room.getObject(f"/PioneerP3DX/{name}")) for name in wheels)
    assert room.getObjectAlias(room.getObject("/Plant[1]"), 2) == "/Plant[1]"
    with pytest.raises(Exception, match="there is no match with index 16"):
        room.getObject("/PioneerP3DX/ultrasonicSensor", {"index": 16})


def test_sonars_are_where_the_data_sheet_has_them_and_look_along_z(floor: Any) -> None:
    robot = floor.getObject("/PioneerP3DX")
    for i, (forward, left, degrees) in enumerate(SONARS):
        sensor = floor.getObject(f"/PioneerP3DX/ultrasonicSensor[{i}]")
        pose = matrix_of(floor, sensor, robot)
        angle = math.radians(degrees)
        assert pose[:2, 3] == pytest.approx([forward / 1000, left / 1000], abs=1e-6)
        assert pose[:, 2] == pytest.approx([math.cos(angle), math.sin(angle), 0], abs=1e-4)
        assert pose[:, 1] == pytest.approx([0, 0, 1], abs=1e-6)
        assert matrix_of(floor, sensor, floor.handle_parent) == pytest.approx(pose, abs=1e-9)
        assert floor.getObjectPosition(sensor, floor.handle_parent) == pytest.approx(pose[:, 3], abs=1e-9)


def test_motors_turn_about_their_z(floor: Any) -> None:
    robot, motor, wheel = (floor.getObject(f"/PioneerP3DX{part}") for part in ("", "/leftMotor", "/leftWheel"))
    assert floor.getObjectOrientation(motor, robot) == pytest.approx([-math.pi / 2, 0, 0], abs=1e-9)
    held = matrix_of(floor, wheel, motor)
    floor.setStepping(True)
    floor.startSimulation()
    for side in ("left", "right"):
        floor.setJointTargetVelocity(floor.getObject(f"/PioneerP3DX/{side}Motor"), 2.0)
    for _ in range(20):
        floor.step()
    assert floor.getJointPosition(motor) > 1
    assert matrix_of(floor, motor, robot)[:, 2] == pytest.approx([0, 1, 0], abs=1e-6)
    assert matrix_of(floor, wheel, motor) == pytest.approx(held, abs=1e-4)  # the frame of a joint moves with its child


@pytest.mark.parametrize("sensor", [2, 3, 4, 5])
def test_a_detected_point_is_in_the_sensors_frame_with_the_distance_along_z(room: Any, sensor: int) -> None:
    place(room, 3.3, 0.8, 0.0)
    room.setStepping(True)
    room.startSimulation()
    room.step()
    handle = room.getObject(f"/PioneerP3DX/ultrasonicSensor[{sensor}]")
    result, distance, point, seen, normal = room.readProximitySensor(handle)
    assert result == 1
    assert room.getObjectAlias(seen) == "walls"
    assert math.hypot(*point) == pytest.approx(distance, abs=1e-6)
    assert point[2] > 0.98 * distance
    pose = room.getObjectMatrix(handle)
    assert room.multiplyVector(pose, point)[0] == pytest.approx(EAST_WALL, abs=1e-3)
    assert matrix_of(room, handle)[:, :3] @ normal == pytest.approx([-1, 0, 0], abs=1e-3)
    nearest = EAST_WALL - 3.3 - SONARS[sensor][0] / 1000
    assert nearest / math.cos(math.radians(20)) + 1e-3 > distance > nearest - 1e-3


def test_a_pixel_is_where_the_frame_of_the_camera_has_its_point(room: Any) -> None:
    camera = room.getObject("/PioneerP3DX/visionSensor")
    place(room, 0.3, 1.0, math.pi / 2)  # to the north wall, with a plant to the right
    room.setStepping(True)  # pose and image of one state: the robot sinks into its contacts, by up to 2 mrad
    room.startSimulation()
    room.step()
    image, (width, height) = room.getVisionSensorImg(camera)
    assert (width, height, len(image)) == (256, 256, 256 * 256 * 3)
    pose = matrix_of(room, camera)
    assert pose[:, 2] == pytest.approx([0, 1, 0], abs=1e-3)
    assert pose[:, 1] == pytest.approx([0, 0, 1], abs=1e-3)
    packed, _ = room.getVisionSensorDepth(camera, 1)
    depth = np.array(room.unpackFloatTable(packed)).reshape(height, width)  # the lowest row first
    focal = width / 2 / math.tan(room.getVisionSensorFieldOfView(camera) / 2)

    def point_at(column: int, row: int) -> npt.NDArray[np.float64]:
        ray = [(width / 2 - column - 0.5) / focal, (row + 0.5 - height / 2) / focal, 1.0]
        return pose @ [*(depth[row, column] * np.array(ray)), 1.0]  # type: ignore[no-any-return]

    assert point_at(60, 170)[1] == pytest.approx(3.0, abs=0.01)  # the wall to the left and above
    assert point_at(128, 20)[2] == pytest.approx(0.0, abs=0.01)  # the floor
    pot = np.array([*room.getObjectPosition(room.getObject("/Plant[0]"))[:2], 0.1])
    x, y, z = pose[:, :3].T @ (pot - pose[:, 3])
    assert x < 0  # it is to the right
    place_of_plant = point_at(round(width / 2 - 0.5 - focal * x / z), round(height / 2 - 0.5 + focal * y / z))
    assert place_of_plant[:2] == pytest.approx([0.9, 2.6], abs=0.2)
    assert room.checkVisionSensor(camera, room.getObject("/Plant[0]"))[0] == 1
    assert room.checkVisionSensor(camera, room.getObject("/Plant[1]"))[0] == 0


SCRIPT_IN_LUA = """\
sim = require 'sim'

function sysCall_init()
    local robot = sim.getObject('.')
    others = sim.createCollection(0)
    sim.addItemToCollection(others, sim.handle_all, -1, 0)
    sim.addItemToCollection(others, sim.handle_tree, robot, 1)
    sonars = {}
    for i = 1, 16 do
        sonars[i] = sim.getObject('./ultrasonicSensor', {index = i - 1})
        sim.setObjectInt32Param(sonars[i], sim.proxintparam_entity_to_detect, others)
    end
    leftMotor = sim.getObject('./leftMotor')
    rightMotor = sim.getObject('./rightMotor')
    self = robot
    nearest = 1
end

function sysCall_actuation()
    local left, right = 3, 3
    for i = 1, 8 do
        local result, distance = sim.readProximitySensor(sonars[i])
        if result > 0 and distance < 0.6 then
            nearest = math.min(nearest, distance)
            local effect = math.min(1, (0.6 - distance) / 0.3)
            left = left - 0.3 * i * effect
            right = right - 0.3 * (9 - i) * effect
        end
    end
    sim.setJointTargetVelocity(leftMotor, left)
    sim.setJointTargetVelocity(rightMotor, right)
end

function sysCall_cleanup()
    local at = sim.getObjectPosition(self, sim.handle_world)
    print(at[1], at[2], sim.getObjectOrientation(self, -1)[3], nearest)
end
"""

SCRIPT_IN_PYTHON = """\
#python
def sysCall_init():
    sim = require('sim')
    self.robot = sim.getObject('.')
    others = sim.createCollection(0)
    sim.addItemToCollection(others, sim.handle_all, -1, 0)
    sim.addItemToCollection(others, sim.handle_tree, self.robot, 1)
    self.sonars = [sim.getObject('./ultrasonicSensor', {'index': i}) for i in range(16)]
    for sonar in self.sonars:
        sim.setObjectInt32Param(sonar, sim.proxintparam_entity_to_detect, others)
    self.motors = sim.getObject('./leftMotor'), sim.getObject(':/rightMotor')
    self.nearest = 1

def sysCall_actuation():
    left = right = 3.0
    for i, sonar in enumerate(self.sonars[:8]):
        result, distance, point, *_ = sim.readProximitySensor(sonar)
        if result and point[2] < 0.6:
            self.nearest = min(self.nearest, distance)
            effect = min(1.0, (0.6 - point[2]) / 0.3)
            left -= 0.3 * (i + 1) * effect
            right -= 0.3 * (8 - i) * effect
    sim.setJointTargetVelocity(self.motors[0], left)
    sim.setJointTargetVelocity(self.motors[1], right)

def sysCall_cleanup():
    x, y, _ = sim.getObjectPosition(self.robot, sim.handle_world)
    print(x, y, sim.getObjectOrientation(self.robot, -1)[2], self.nearest)
"""


@pytest.mark.parametrize(
    ("name", "code"), [("script.lua", SCRIPT_IN_LUA), ("script.py", SCRIPT_IN_PYTHON)], ids=["lua", "python"]
)
def test_a_child_script_turns_the_robot_away_from_walls(tmp_path: Path, name: str, code: str) -> None:
    run = run_script(tmp_path, code, "--strict", name=name, scene="p3dx_room", target="/PioneerP3DX", until=30)
    assert (run.stderr, run.returncode) == ("", 0)
    x, y, heading, nearest = map(float, run.stdout.split())
    assert abs(x) < 3.9
    assert abs(y) < 2.9
    assert heading != pytest.approx(0.4, abs=0.2)
    assert 0.05 < nearest < 0.6
