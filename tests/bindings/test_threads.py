# SPDX-License-Identifier: BSD-3-Clause
"""A simulation that one Python thread steps while others read and change it. Each test runs in its own process, because
an error in the core may crash it."""

import subprocess
import sys
import threading

import pytest

import bubblesim
from ros_support import DEADLINE

PROGRAM = """
import math, random, sys, threading, time
import bubblesim

simulation = bubblesim.Simulation(sys.argv[1])
world = simulation.world
start = simulation.state_hash()
ROBOT, WHEEL = simulation.object(sys.argv[2]), simulation.object(sys.argv[3])
SENSORS = [thing for thing in simulation.objects if thing.kind == "sensor"]
SHAPE = "<geometry><box><size>0.1 0.1 0.1</size></box></geometry>"
BOX = (
    '<sdf version="1.9"><model name="Box"><pose>3 3 1 0 0 0</pose><link name="link"><collision name="c">' + SHAPE
    + '</collision><visual name="v">' + SHAPE + "</visual></link></model></sdf>"
)
lock = threading.Lock()

def move():
    ROBOT.position = [random.uniform(-1, 1), random.uniform(-1, 1), 0.05]
    half = random.uniform(-1, 1)
    ROBOT.orientation = [0, 0, math.sin(half), math.cos(half)]
    world.set_pose(ROBOT.handle, [0, 0, 0.05, 0, 0, 0, 1])

def speed():
    ROBOT.linear_velocity = [random.uniform(-1, 1), 0, 0]
    ROBOT.angular_velocity = [0, 0, random.uniform(-1, 1)]
    world.set_state(ROBOT.handle, [0, 0, 0.05, 0, 0, 0, 1], [0, 0, 0], [0, 0, 0])
    world.set_planar_velocity(ROBOT.handle, 0.1, 0, 0.1)

def joints():
    WHEEL.target_velocity = random.uniform(-5, 5)
    WHEEL.target_position = random.uniform(-0.1, 0.1)
    WHEEL.max_force = 10.0
    world.set_motor_mode(WHEEL.handle, bubblesim._core.MotorMode.VELOCITY)
    WHEEL.joint_position, WHEEL.joint_velocity, world.motor_effort(WHEEL.handle)

def read():
    ROBOT.position, ROBOT.linear_velocity, ROBOT.urdf, ROBOT.path, repr(ROBOT), ROBOT.parent
    simulation.time, simulation.state_hash(), len(simulation.objects), len(simulation.collisions)
    world.pose_in(ROBOT.handle, WHEEL.handle), world.acceleration(ROBOT.handle), simulation.object(sys.argv[2])

def measure():
    for sensor in SENSORS:
        sensor.reading
        bubblesim._core.read_sensor(simulation, sensor.handle)

def reset():
    simulation.reset()

def reset_world():
    simulation.reset_world()

def models():
    with lock:
        simulation.remove_model(simulation.add_model(BOX).handle)

def boxes():
    box = simulation.add_model(BOX, name=f"Box{random.random()}")
    try:
        box.position = [1, 1, 1]
        box.position, box.path
    finally:
        simulation.remove_model(box.handle)

def time_step():
    simulation.set_time_step(random.choice([0.05, 0.02]))

failures = []
over = threading.Event()
counts = {}

def repeat(action):
    while not over.is_set():
        try:
            action()
            counts[action.__name__] = counts.get(action.__name__, 0) + 1
        except Exception as error:
            failures.append(f"{action.__name__}: {error!r}")
            return

def step():
    simulation.step(3)

actions = [globals()[name] for name in sys.argv[4:]]
threads = [threading.Thread(target=repeat, args=(action,)) for action in [step, *actions]]
for thread in threads: thread.start()
end = time.monotonic() + 1.0
while (time.monotonic() < end or len(counts) <= len(actions)) and not failures: time.sleep(0.01)
over.set()
for thread in threads: thread.join()
assert not failures, failures
assert set(counts) == {"step", *(action.__name__ for action in actions)}, counts
simulation.reset()
assert simulation.state_hash() == start, "equal to a new simulation after all"
"""

MODES = ["move", "speed", "joints", "read", "measure", "reset", "reset_world", "models", "boxes", "time_step"]
SCENES = {"tricycle": ("/Tricycle", "/FrontMotor"), "pioneer": ("/Pioneer_p3dx", "/Pioneer_p3dx_leftMotor")}


@pytest.mark.parametrize("scene", SCENES)
@pytest.mark.parametrize("actions", [*([mode] for mode in MODES), MODES], ids="+".join)
def test_threads_use_a_simulation_that_another_steps(scene: str, actions: list[str]) -> None:
    command = [sys.executable, "-X", "faulthandler", "-c", PROGRAM, scene, *SCENES[scene], *actions]
    run = subprocess.run(command, capture_output=True, text=True, timeout=6 * DEADLINE, check=False)
    assert run.returncode == 0, run.stderr


def test_a_thread_that_steps_without_end_keeps_nobody_out() -> None:
    simulation = bubblesim.Simulation("ball")
    ball = simulation.object("/Ball")
    stepping = threading.Thread(target=simulation.step, args=(300_000,))
    stepping.start()
    moved = 0
    while stepping.is_alive():
        ball.position = [0, 0, 1]
        moved += 1
    stepping.join()
    assert moved > 100
    assert simulation.time == pytest.approx(15_000)


def test_threads_that_step_take_turns() -> None:
    simulation = bubblesim.Simulation("tricycle")
    threads = [threading.Thread(target=simulation.step, args=(500,)) for _ in range(3)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert simulation.time == pytest.approx(1500 * 0.05)
    alone = bubblesim.Simulation("tricycle")
    alone.step(1500)
    assert simulation.state_hash() == alone.state_hash()
