# SPDX-License-Identifier: BSD-3-Clause
"""Public files of CoppeliaSim without their scripts: how they stand, drive and hold still, and what they cost."""

import math
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

import bubblesim
from bubblesim import MotorMode
from public_foreign_files import FILES, cases, each_of, find, matrix, named, needs_files
from ros_support import built
from ttt_reader import FileObject, roots, unpacked

pytestmark = needs_files


MOVES = {
    # What falls, or drives off, by its file: bodies beside the floor or that collide with nothing.
    "pioneer-path-large-objetos-rojos.ttt": {"Sphere"},
    "pioneer-path-large.ttt": {"Sphere"},
    # Aircraft without a script.
    "scene_quadcopter.ttt": {"*"},
    "quadcopter ronda teste.ttt": {"*"},
    "drone_with_rope_2.ttt": {"*"},
    # Arms and pendulums without motors.
    "dnn_cart_pole.ttt": {"pole", "mass"},
    "impedance.ttt": {"link2"},
    "vrep_model.ttt": {"*"},
}
FASTEST = 4.0
"""m/s, of bodies that may move: wheels of robots that drive, arms that go to their targets."""
WIDEST = 3e-3
"""m, that the two sides of a joint are apart."""


@pytest.mark.parametrize("file", cases(25))
def test_bodies_keep_together_and_stand(file: Path) -> None:
    simulation = bubblesim.Simulation(str(file))
    world = simulation.world
    moving = [model for model in world.models if not world.is_static(model)]
    links = [link for model in moving for link in world.parts(model, "link")]
    joints = [joint for model in moving for joint in world.parts(model, "joint")]
    heights = {link: world.pose(link)[2] for link in links}
    free = MOVES.get(file.name, set())
    bound = [link for link in links if "*" not in free and world.name(link) not in free]
    while simulation.time < 10:
        simulation.step(1)
        for joint in joints:
            x, y, z = world.pose_in(joint, joint)[:3]
            along = 0 if world.joint_type(joint) in ("prismatic", "screw") else z
            assert math.hypot(x, y, along) < WIDEST, (world.name(joint), simulation.time)
        for link in bound:
            assert math.hypot(*world.velocity(link)[0]) < FASTEST, (world.name(link), simulation.time)
    assert [world.name(link) for link in bound if world.pose(link)[2] < heights[link] - 0.3] == []


MOTORS = {
    "Pioneer_p3dx_leftMotor": """scene_pioneer.ttt pioneer_p3dx.ttm ros_pioneer.ttt ros_pioneer_plane.ttt camera.ttt
        arena.ttt arena2.ttt""",
    # That of pioneer_obtaculo.ttt stands before a wall.
    "leftMotor": """24bcs11986.ttt rename.ttt pioneer_python_control.ttt obstaculos.ttt pioneer_p3dx.ttt
        Escenario_Proyecto.ttt Escenario_Proyecto_Cuadrado.ttt Escenario_Proyecto_Sin_Obstaculos.ttt
        escena-practica-completo.ttt pioneer-path-large.ttt pioneer-path-large-objetos-rojos.ttt""",
    "DynamicLeftJoint": "camera_diff_drive_robot.ttm green_sphere_following.ttt local_path_FSM.ttt",
    "bubbleRob_leftMotor1": "escapeObstacle.ttt",
}
"""The left motors of robots on two wheels, BubbleRobs, LineTracers and Pioneers, and their files."""
DRIVES = [(file, motor) for motor, files in MOTORS.items() for file in find(*files.split())]
SPEED = 0.1
"""m/s, of the rims."""


def wheel_of(motor: str, objects: list[FileObject], above: np.ndarray) -> tuple[float, np.ndarray] | None:
    """Return the radius of the wheel on a motor, and its centre in the world, from the file."""
    for each in objects:
        here = above @ each.frame
        if each.name == motor:
            wheel = next(child for child in each.children if child.shape is not None and not child.shape.is_static)
            assert wheel.shape is not None
            frame = each.motion @ wheel.frame
            points = np.concatenate([part.points for part in wheel.shape.parts]) @ frame[:3, :3].T + frame[:3, 3]
            centre = here @ np.append((points.max(axis=0) + points.min(axis=0)) / 2, 1)
            return float(np.hypot(points[:, 0], points[:, 1]).max()), centre[:3]
        found = wheel_of(motor, each.children, here @ each.motion)
        if found is not None:
            return found
    return None


@pytest.mark.parametrize(("file", "motor"), DRIVES, ids=[named(file) for file, _ in DRIVES])
def test_robots_drive_and_turn_by_their_kinematics(file: Path, motor: str) -> None:
    simulation = bubblesim.Simulation(str(file))
    world = simulation.world
    names = motor, motor.replace("left", "right").replace("Left", "Right")
    joints = {world.alias(joint): joint for model in world.models for joint in world.parts(model, "joint")}
    left, right = (joints[name] for name in names)
    (radius, one), (_, other) = (found for name in names if (found := wheel_of(name, roots(file), np.eye(4))))
    track = float(np.linalg.norm(one - other))
    base = world.joint_links(left)[0]
    seconds = round(1 / simulation.time_step)
    for sign in (1, -1):  # straight, on the spot
        world.set_target_velocity(left, sign * SPEED / radius)
        world.set_target_velocity(right, SPEED / radius)
        simulation.step(seconds)
        before = world.pose(base)
        simulation.step(seconds)
        after = world.pose(base)
        if sign > 0:
            assert math.dist(before[:2], after[:2]) == pytest.approx(SPEED, rel=0.01)
        else:
            turned = matrix(before)[:3, :3].T @ matrix(after)[:3, :3]
            assert math.acos((np.trace(turned) - 1) / 2) == pytest.approx(2 * SPEED / track, rel=0.01)


ARMS = find("01_intro_control_joint.ttt", "project2567_841.ttt")  # UR5 with an RG2 gripper
ARMS += find("dnf_learning_scene.ttt", "dnf_recall_scene.ttt")  # Franka
ARMS += find("ros_robot.ttt", "test_sendTransform.ttt")  # UR5, IRB 140


@pytest.mark.parametrize("file", each_of(ARMS))
def test_arms_hold_still_and_move_without_thrashing(file: Path) -> None:
    simulation = bubblesim.Simulation(str(file))
    world = simulation.world
    moving = [model for model in world.models if not world.is_static(model)]
    joints = [joint for model in moving for joint in world.parts(model, "joint") if world.joint_axes(joint) == 1]
    motors = [joint for joint in joints if world.motor_mode(joint) == MotorMode.POSITION]

    def fastest() -> float:
        return max(abs(world.joint_velocity(joint)) for joint in joints)

    second = round(1 / simulation.time_step)
    simulation.step(4 * second)
    for _ in range(2 * second):
        simulation.step(1)
        assert fastest() < 1e-3
    for joint in motors:
        here = world.joint_position(joint)
        world.set_target_position(joint, here + (0.3 if here + 0.3 < world.joint_limits(joint)[1] else -0.3))
    for _ in range(3 * second):
        simulation.step(1)
        assert all(abs(world.joint_velocity(joint)) < 1.01 * world.max_velocity(joint) for joint in motors)
    assert fastest() < 1e-3
    for joint in motors:
        assert world.joint_position(joint) == pytest.approx(world.target_position(joint), abs=1e-3)


LOAD = """
import resource, sys, bubblesim

def peak():
    return next(int(line.split()[1]) for line in open("/proc/self/status") if line.startswith("VmHWM"))

bubblesim.Simulation("ball")
memory, before = peak(), resource.getrusage(resource.RUSAGE_SELF)
bubblesim.Simulation(sys.argv[1])
after, child = resource.getrusage(resource.RUSAGE_SELF), resource.getrusage(resource.RUSAGE_CHILDREN)
print(after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime + child.ru_utime + child.ru_stime)
print(1024 * (peak() - memory))
"""
PROGRAM = 10_000_000
"""Bytes of addresses that the converter takes for a box, with its libraries."""


@pytest.mark.parametrize("file", each_of(FILES[-3:]))
def test_the_largest_load_within_two_seconds_and_ten_times_their_size(file: Path, tmp_path: Path) -> None:
    """The time is that of the processor, with the first conversion: other tests may run beside."""
    most = 10 * len(unpacked(file))
    run = subprocess.run([sys.executable, "-c", LOAD, str(file)], capture_output=True, text=True, check=True)
    seconds, memory = (float(number) for number in run.stdout.split())
    assert seconds < 2
    assert memory < most
    limited = f'ulimit -v {(most + PROGRAM) // 1024}; exec "$@"'
    convert = [built("scene_converter"), "convert", file, tmp_path]
    subprocess.run(["bash", "-c", limited, "bash", *map(str, convert)], check=True, stdout=subprocess.DEVNULL)
