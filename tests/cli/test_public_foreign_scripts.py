# SPDX-License-Identifier: BSD-3-Clause
"""Public files of CoppeliaSim with their scripts: which run for 10 s, and what they do."""

import math
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import bubblesim
from node_support import run_sim
from public_foreign_files import FILES, cases, each_of, find, named, needs_files
from remote_support import RemoteNode

pytestmark = needs_files

SHORT = 12
SECONDS = 10

LACKING = {
    # Programs or files that are not beside the scene in its repository.
    "test_float.ttt": "a script that it includes",
    "ros_robot.ttt": "a script that it includes, and ROS",
    "arena.ttt": "scripts that it includes",
    "arena2.ttt": "scripts that it includes",
    "scene_quadcopter.ttt": "signals of a program outside: without them its scripts compute with nil, there too",
    # What we lack.
    "Robotnik_Summit_XL.ttt": "simExtROS, a plugin of V-REP 3.2",
    "Robotnik_Summit_XL_STD.ttm": "simExtROS, a plugin of V-REP 3.2",
    # A node of ROS: they fail at once without one, there too.
    "test_sendTransform.ttt": "ROS 1",
    "pioneer_p3dx.ttm": "ROS 1",
    "ros_pioneer.ttt": "ROS 1",
    "ros_pioneer_plane.ttt": "ROS 1",
    "drone_with_rope_2.ttt": "ROS 1",
    "action_client.ttt": "ROS 2",
    "action_server.ttt": "ROS 2",
    "service_client.ttt": "ROS 2",
    "service_server.ttt": "ROS 2",
    "topic_publisher.ttt": "ROS 2",
    "topic_subscriber.ttt": "ROS 2",
    "camera_diff_drive_robot.ttm": "ROS 2",
    "green_sphere_following.ttt": "ROS 2",
    "local_path_FSM.ttt": "ROS 2",
    "escena-practica-completo.ttt": "ROS 2",
    "escena-practica-completo-slam.ttt": "ROS 2",
}
"""What the scripts of a scene need that is not there when it runs alone."""
SLOW = {"Proyecto02_scene.ttt": "22,500 collision checks in a step: it is interrupted when the run ends"}
COMPLETE = [file for file in FILES if file.name not in LACKING]


def run(file: Path, *more: object, until: float = SECONDS) -> tuple[int, str]:
    """Run a scene with its scripts; return the exit code, 3 when a script has failed, and what is reported."""
    options = ("--no-ros", "--allow-python-scripts", "--speed", "max", "--until", until, "--strict")
    done = run_sim(file, *options, *more, timeout=300)
    return done.returncode, done.stderr


@pytest.mark.parametrize("file", cases(SHORT, [file for file in COMPLETE if file.name not in SLOW]))
def test_scripts_run_without_an_error(file: Path) -> None:
    code, reported = run(file)
    assert code == 0, reported
    assert "error:" not in reported


def test_at_least_nine_in_ten_scenes_that_lack_nothing_run() -> None:
    """The files that the test above leaves out, among those whose scripts need nothing that we lack."""
    ours = "simExtROS"
    could_run = [file for file in FILES if file.name not in LACKING or LACKING[file.name].startswith(ours)]
    fail = [file.name for file in could_run if file.name in SLOW or file.name in LACKING]
    assert len(fail) <= 0.1 * len(could_run)


def state_after(file: Path, folder: Path, seconds: float, *more: object) -> bubblesim.Simulation:
    """Return a simulation in the state to which the scripts have brought the scene."""
    code, reported = run(file, "--save-state", folder / "state", *more, until=seconds)
    assert code == 0, reported
    simulation = bubblesim.Simulation(str(file))
    simulation.restore((folder / "state").read_bytes())
    return simulation


def line_of(file: Path) -> np.ndarray:
    """Return the points of the path of a scene, x and y in the world."""
    world = bubblesim.Simulation(str(file)).world
    path = next(handle for handle in world.children(-1) if "PATH" in world.file_data(handle))
    points = np.frombuffer(world.file_data(path)["PATH"], float).reshape(-1, 7)
    assert world.pose(path)[3:] == [0, 0, 0, 1]
    return points[:, :2] + np.array(world.pose(path)[:2])


@pytest.mark.parametrize(
    ("file", "robot", "reach"),
    [
        pytest.param(file, *of, id=named(file))
        for name, of in {
            "24bcs11986.ttt": ("/bubbleRob", 0.1),
            "line follower.ttt": ("/LineFollower", 0.1),
            "part2_LFR_LUA.ttt": ("/LFR", 0.1),
        }.items()
        for file in find(name)
    ],
)
def test_robots_follow_the_line_of_their_scene(file: Path, robot: str, reach: float, tmp_path: Path) -> None:
    line = line_of(file)
    places = [state_after(file, tmp_path, seconds).object(robot).position[:2] for seconds in (10, 15, 20)]
    for place in places:
        assert np.linalg.norm(line - place, axis=1).min() < reach
    assert math.dist(places[0], places[1]) > 0.2
    assert math.dist(places[1], places[2]) > 0.2


@pytest.mark.parametrize("file", each_of(find("quadcopter ronda teste.ttt")))
def test_a_quadcopter_flies_after_its_target(file: Path, tmp_path: Path) -> None:
    """Its script moves the target 25 mm in 25 ms of the computer's clock: the busier the machine, the faster."""
    seconds = 10.0
    simulation = state_after(file, tmp_path, seconds)
    (target,) = (each for each in simulation.objects if each.path == "/Quadcopter/target")
    copter = simulation.object("/Quadcopter")
    start = bubblesim.Simulation(str(file)).object("/Quadcopter").position
    speed = math.dist(target.position, start) / seconds
    behind = math.dist(copter.position, target.position) / speed
    assert behind < 1.0  # s
    assert math.dist(copter.position, start) > 1


def velocity_in_two_seconds(sim: Any, robot: int) -> tuple[list[float], float]:
    """Return the mean velocity of a robot in its axes at the start, m/s, and its turning rate, rad/s."""
    matrix, start = sim.getObjectMatrix(robot), sim.getObjectPosition(robot)
    for _ in range(40):
        sim.step()
    first, last = np.array(matrix).reshape(3, 4)[:, :3], np.array(sim.getObjectMatrix(robot)).reshape(3, 4)[:, :3]
    moved = first.T @ np.subtract(sim.getObjectPosition(robot), start) / 2
    return list(moved), math.acos(min(1, (np.trace(first.T @ last) - 1) / 2)) / 2


@pytest.mark.parametrize("file", each_of([file for file in FILES if file.name.startswith("Indoor")]))
def test_a_youbot_drives_on_its_mecanum_wheels_by_their_scripts(file: Path, tmp_path: Path) -> None:
    """Speeds of a platform on rollers at 45 degrees: ahead and aside r w, on the spot r w / (a + b)."""
    with RemoteNode(tmp_path, "--speed", "max", "--paused", scene=str(file)) as node:
        sim = node.sim()
        sim.setStepping(True)
        sim.startSimulation()
        robot = sim.getObject("/youBot")
        motors = [sim.getObject(f"/rollingJoint_{corner}") for corner in ("fl", "rl", "rr", "fr")]
        radius = sim.getObjectFloatParam(sim.getObject("/wheel_respondable_fl"), sim.objfloatparam_objbbox_max_z)
        left, right = sim.getObjectPosition(motors[1]), sim.getObjectPosition(motors[3])
        reach = (abs(left[0] - right[0]) + abs(left[1] - right[1])) / 2
        speed = 5.0  # rad/s

        def drive(*signs: int) -> tuple[list[float], float]:
            for motor, sign in zip(motors, signs, strict=True):
                sim.setJointTargetVelocity(motor, speed * sign)
            sim.wait(1)
            return velocity_in_two_seconds(sim, robot)

        ahead, turned = drive(-1, -1, -1, -1)
        assert ahead == pytest.approx([0, 0, radius * speed], rel=0.01, abs=2e-3)
        assert turned < 0.01
        aside, turned = drive(1, -1, 1, -1)
        assert aside == pytest.approx([0, -radius * speed, 0], rel=0.01, abs=4e-3)
        assert turned < 0.01
        moved, turned = drive(-1, -1, 1, 1)
        assert turned == pytest.approx(radius * speed / reach, rel=0.01)
        assert math.hypot(*moved) < 0.01
        assert "has no effect" not in node.output
