# SPDX-License-Identifier: BSD-3-Clause
"""The functions of `sim`, called by scripts that check the results themselves."""

from pathlib import Path

import pytest

from node_support import in_init, processes_with, run_script
from ros_support import wait_until


def check(folder: Path, body: str, scene: str = "ball", target: str = "/Ball", until: float = 0.1) -> str:
    """Run `body` in sysCall_init; an error fails the test. Return what it printed."""
    header = "import math\nimport numpy as np\nnear = lambda a, b: np.testing.assert_allclose(a, b, atol=1e-9)\n"
    run = run_script(folder, header + in_init(body), "--strict", scene=scene, target=target, until=until)
    assert run.stderr == ""
    assert run.returncode == 0
    return run.stdout


def test_objects_are_found_by_path(tmp_path: Path) -> None:
    body = """
trike = sim.getObject('/Tricycle')
motor = sim.getObject('/Tricycle/FrontMotor')
assert sim.getObject('.') == trike
assert sim.getObject('/FrontMotor') == sim.getObject('./FrontMotor') == sim.getObject(':/FrontMotor') == motor
assert sim.getObject('./FrontMotor', {'proxy': trike}) == motor
assert sim.getObjectHandle('FrontMotor') == motor
assert sim.getObject('/Nothing', {'noError': True}) == -1
assert sim.getObject('/*Motor') == motor
assert sim.getObjectParent(motor) == trike
assert sim.getObjectParent(trike) == -1
assert sim.getObjectChild(trike, 0) >= 0 and sim.getObjectChild(trike, 99) == -1
assert sim.getObjectAssociatedWithScript(sim.handle_self) == trike
assert sim.getObjectType(motor) == sim.object_joint_type
assert sim.getObjectType(sim.getObject('/FrontSonar')) == sim.object_proximitysensor_type
"""
    check(tmp_path, body, "tricycle", "/Tricycle")


def test_aliases_follow_the_option(tmp_path: Path) -> None:
    body = """
h = sim.getObject('/Tricycle/FrontSonar')
print(*(sim.getObjectAlias(h, option) for option in (-1, 0, 1, 2, 3, 5)), sim.getObjectName(h))
assert sim.getObjectAlias(h, 4) == f'FrontSonar__{h}__'
"""
    full = "/Tricycle/base_link/FrontSonar"
    expected = f"FrontSonar FrontSonar /FrontSonar {full} FrontSonar {full} FrontSonar\n"
    assert check(tmp_path, body, "tricycle", "/Tricycle") == expected


def test_positions_take_both_argument_orders(tmp_path: Path) -> None:
    body = """
h, w = sim.getObject('.'), sim.handle_world
for call in (lambda p: sim.setObjectPosition(h, p), lambda p: sim.setObjectPosition(h, p, w),
             lambda p: sim.setObjectPosition(h, w, p), lambda p: sim.setObjectPosition(h, -1, np.array(p))):
    sim.setObjectPosition(h, [0, 0, 9])
    call([1, 2, 3])
    near(sim.getObjectPosition(h), [1, 2, 3])
    near(sim.getObjectPosition(h, w), [1, 2, 3])
pose = [1, 2, 3, 0, 0, math.sin(0.2), math.cos(0.2)]
sim.setObjectPose(h, -1, pose)
near(sim.getObjectPose(h), pose)
sim.setObjectPose(h, pose, -1)
near(sim.getObjectPose(h, -1), pose)
sim.setObjectQuaternion(h, -1, [0, 0, 1, 0])
near(np.abs(sim.getObjectQuaternion(h)), [0, 0, 1, 0])
near(sim.getObjectPosition(h), [1, 2, 3])
"""
    check(tmp_path, body)


def test_poses_relative_to_an_object(tmp_path: Path) -> None:
    body = """
h, ramp = sim.getObject('.'), sim.getObject('/Ramp')
c, s = math.cos(0.2), math.sin(0.2)  # the ramp is rotated by 0.2 about y, at (-1, 0, 0.1)
turn = np.array([[c, 0, s], [0, 1, 0], [-s, 0, c]])
sim.setObjectPosition(h, [0.3, 0.4, 0.5], ramp)
near(sim.getObjectPosition(h), turn @ [0.3, 0.4, 0.5] + [-1, 0, 0.1])
near(sim.getObjectPosition(h, ramp), [0.3, 0.4, 0.5])
sim.setObjectOrientation(h, [0, 0, 0], ramp)
near(sim.getObjectOrientation(h), [0, 0.2, 0])
near(sim.getObjectPosition(h, sim.handle_parent), sim.getObjectPosition(h))
"""
    check(tmp_path, body)


def test_poses_relative_to_a_joint_use_its_moving_frame(tmp_path: Path) -> None:
    code = """
        import numpy as np
        def sysCall_init():
            sim.setJointTargetPosition(sim.getObject('/Steering'), 0.5)
        def sysCall_cleanup():
            steering, fork = sim.getObject('/Steering'), sim.getObject('/fork')
            assert abs(sim.getJointPosition(steering) - 0.5) < 1e-3
            # The fork turns with the joint and has the same frame.
            np.testing.assert_allclose(sim.getObjectPosition(fork, steering), [0, 0, 0], atol=1e-3)
            np.testing.assert_allclose(sim.getObjectOrientation(fork, steering), [0, 0, 0], atol=1e-3)
            x, y, z = sim.getObjectPosition(sim.getObject('/Tricycle'), steering)
            np.testing.assert_allclose([x, y], [-np.cos(0.5), np.sin(0.5)], atol=2e-3)
    """
    run = run_script(tmp_path, code, "--strict", scene="tricycle", target="/Tricycle", until=2)
    assert run.stderr == ""
    assert run.returncode == 0


def test_euler_angles_and_matrices_are_those_of_rotation_matrices(tmp_path: Path) -> None:
    body = """
def rx(a): return np.array([[1, 0, 0], [0, math.cos(a), -math.sin(a)], [0, math.sin(a), math.cos(a)]])
def ry(a): return np.array([[math.cos(a), 0, math.sin(a)], [0, 1, 0], [-math.sin(a), 0, math.cos(a)]])
def rz(a): return np.array([[math.cos(a), -math.sin(a), 0], [math.sin(a), math.cos(a), 0], [0, 0, 1]])
h = sim.getObject('.')
random = np.random.default_rng(1)
for _ in range(200):
    a, b, c = random.uniform(-3.1, 3.1), random.uniform(-1.5, 1.5), random.uniform(-3.1, 3.1)
    position = random.uniform(-5, 5, 3)
    sim.setObjectPosition(h, position)
    sim.setObjectOrientation(h, [a, b, c])
    near(sim.getObjectOrientation(h), [a, b, c])
    near(sim.getObjectMatrix(h), np.column_stack([rx(a) @ ry(b) @ rz(c), position]).ravel())
for b in (math.pi / 2, -math.pi / 2):  # where the first and the third axis coincide
    sim.setObjectOrientation(h, [0.3, b, 0.4])
    matrix = sim.getObjectMatrix(h)
    sim.setObjectOrientation(h, sim.getObjectOrientation(h))
    np.testing.assert_allclose(sim.getObjectMatrix(h), matrix, atol=1e-7)
"""
    check(tmp_path, body)


def test_velocity_is_that_of_a_falling_body(tmp_path: Path) -> None:
    code = """
        def sysCall_init(): sim.setObjectPosition(sim.getObject('.'), [5, 0, 50])
        def sysCall_cleanup():
            linear, angular = sim.getObjectVelocity(sim.getObject('.'))
            assert abs(linear[2] + 9.8 * 0.5) < 0.02, linear
            assert linear[:2] == [0, 0] and angular == [0, 0, 0]
    """
    assert run_script(tmp_path, code, "--strict", until=0.5).returncode == 0


def test_joints_read_back_what_was_set(tmp_path: Path) -> None:
    body = """
steering, motor = sim.getObject('/Steering'), sim.getObject('/FrontMotor')
sim.setJointTargetPosition(steering, 0.25)
sim.setJointTargetVelocity(motor, np.float32(1.5))
sim.setJointTargetForce(motor, -20)
assert sim.getJointTargetPosition(steering) == 0.25
assert sim.getJointTargetVelocity(motor) == 1.5
assert sim.getJointTargetForce(motor) == 20
sim.setJointMaxForce(motor, 30)
assert sim.getJointTargetForce(motor) == 30
near([sim.getJointPosition(motor), sim.getJointVelocity(motor)], [0, 0])
"""
    check(tmp_path, body, "tricycle", "/Tricycle")


def test_proximity_sensor_gives_five_values(tmp_path: Path) -> None:
    body = """
sonar = sim.getObject('/FrontSonar')
assert sim.readProximitySensor(sonar) == (0, 0.0, [0, 0, 0], -1, [0, 0, 0]), sim.readProximitySensor(sonar)
x, y, z = sim.getObjectPosition(sonar)
walls = {}
for yaw in (0, math.pi / 2, math.pi, -math.pi / 2):
    sim.setObjectOrientation(sim.getObject('.'), [0, 0, yaw])
    seen, distance, point, obj, normal = sim.handleProximitySensor(sonar)
    walls[yaw] = distance
    if seen:
        near(np.linalg.norm(point), distance)
        near(np.linalg.norm(normal), 1)
        assert obj >= 0
        assert sim.readProximitySensor(sonar)[1] == distance
assert any(walls.values())
"""
    check(tmp_path, body, "tricycle", "/Tricycle")


def test_times(tmp_path: Path) -> None:
    body = """
assert sim.getSimulationTime() == 0.0
assert sim.getSimulationTimeStep() == 0.05
import time
first = sim.getSystemTime()
start = sim.getSystemTimeInMs(-1)
assert abs(sim.getSystemTimeInMs(-2) - time.time() * 1000) < 5000
time.sleep(0.05)
assert sim.getSystemTime() >= first + 0.05
assert sim.getSystemTimeInMs(start) >= 49
assert sim.getSimulationState() == sim.simulation_advancing_running == 0x11
"""
    check(tmp_path, body)


BAD_CALLS = {
    "sim.getObject('/Bal')": "NoSuchObject: no object matches '/Bal'; did you mean /Ball?",
    "sim.getObject(5)": "sim.getObject: argument 1, path: expected a string, found int 5",
    "sim.getObject()": "sim.getObject(path, options): missing a required argument: 'path'",
    "sim.getObject('/Ball', {}, 3)": "sim.getObject(path, options): too many positional arguments",
    "sim.getObject('/Ball', index=1)": "sim.getObject(path, options): got an unexpected keyword argument 'index'",
    "sim.getObject('/Ball', 'index')": "argument 2, options: expected a table of options by name, found str 'index'",
    "sim.getObject('/Ball', {'noerror': 1})": "ValueError: getObject has no option 'noerror'",
    "sim.getObjectPosition('/Ball')": "an integer, found str '/Ball'; sim.getObject('/Ball') returns it",
    "sim.getObjectPosition(999)": "NoSuchObject: no object has the handle 999",
    "sim.getObjectPosition(-77)": "sim.getObjectPosition: argument 1, handle: -77 is not a handle of an object",
    "sim.setObjectPosition(sim.handle_self, [1, 2])": "argument 2, position: expected 3 numbers, found 2",
    "sim.setObjectPosition(sim.handle_self, 'abc')": "argument 2, position: expected 3 numbers, found str 'abc'",
    "sim.setObjectPosition(sim.handle_self, [1, None, 2])": "position: expected 3 numbers, found list [1, None, 2]",
    "sim.setObjectPosition(sim.handle_self, [1, 2, float('nan')])": "finite",
    "sim.setObjectQuaternion(sim.handle_self, [0, 0, 0, 0])": "uaternion",
    "sim.setJointTargetVelocity(sim.handle_self, 1)": "/Ball is a model, not a joint",
    "sim.setJointTargetVelocity(sim.handle_self, 'x')": "argument 2, velocity: expected a number, found str 'x'",
    "sim.readProximitySensor(sim.handle_self)": "/Ball is a model, not a proximity sensor",
    "sim.launchExecutable('echo', '\"open')": "ValueError: No closing quotation",
}


@pytest.mark.parametrize("call", BAD_CALLS)
def test_bad_calls_are_explained(tmp_path: Path, call: str) -> None:
    run = run_script(tmp_path, f"def sysCall_init():\n    {call}\n", "--strict")
    assert run.returncode == 3
    assert BAD_CALLS[call] in run.stderr.splitlines()[-1]
    assert "incompatible function arguments" not in run.stderr


def test_a_floor_that_cannot_be_moved_is_a_warning(tmp_path: Path) -> None:
    body = "def sysCall_init():\n    sim.setObjectPosition(sim.getObject('/Floor'), [1, 2, 3])\n    print('goes on')\n"
    run = run_script(tmp_path, body, "--strict")
    assert (run.returncode, run.stdout) == (0, "goes on\n")
    assert "sim.setObjectPosition has no effect: /Floor has an infinite plane" in run.stderr


def test_a_launched_program_gets_its_arguments_as_a_shell_would_split_them(tmp_path: Path) -> None:
    body = """
import os
sim.launchExecutable('python3', "-c 'import sys; print(sys.argv[1:])' one 'two words' $HOME")
os.wait()
"""
    assert check(tmp_path, body) == "['one', 'two words', '$HOME']\n"


def test_a_launched_program_ends_with_the_simulation(tmp_path: Path) -> None:
    mark = "36057.25"
    assert check(tmp_path, f"sim.launchExecutable('sleep', '{mark}')\nprint('launched')\n") == "launched\n"
    assert processes_with(f"sleep {mark}") == []


def test_a_launched_program_that_ignores_sigterm_is_ended(tmp_path: Path) -> None:
    mark = "unwilling_program_of_a_test"
    code = "import signal, time; signal.signal(signal.SIGTERM, signal.SIG_IGN); time.sleep(60)"
    check(tmp_path, f"""sim.launchExecutable('python3', '-c "{code}" {mark}')\nimport time\ntime.sleep(0.5)\n""")
    assert processes_with(mark) == []


def test_what_a_launched_program_has_started_ends_with_it(tmp_path: Path) -> None:
    mark = "36057.75"
    code = f"""sim.launchExecutable('bash', '-c "sleep {mark} & wait"')\nimport time\ntime.sleep(0.5)\n"""
    check(tmp_path, code)
    # The node has killed it, but cannot wait for it: it is not its child.
    wait_until(lambda: processes_with(f"sleep {mark}") == [], "the end of what the program has started")


def test_logs_go_where_their_level_belongs(tmp_path: Path) -> None:
    code = """
        def sysCall_init():
            sim.addLog(sim.verbosity_scripterrors, 'an error')
            sim.addLog(sim.verbosity_scriptwarnings, 'a warning')
            sim.addLog(sim.verbosity_scriptinfos, 'an info')
            sim.addLog(sim.verbosity_debug, 'a detail')
            sim.addStatusbarMessage('status')
    """
    run = run_script(tmp_path, code)
    assert run.stderr == "error: /Ball: an error\nwarning: /Ball: a warning\n"
    assert run.stdout == "info: /Ball: an info\ninfo: /Ball: status\n"


def test_logging_never_raises(tmp_path: Path) -> None:
    body = """
class Odd:
    def __str__(self): raise ValueError('no text')
for level in (-5, 0, 100, 420, 10**30, 450.5, 'info', None, [1]):
    for text in ('text', None, 5, chr(0xdc80), Odd(), b'bytes'):
        sim.addLog(level, text)
print('done')
"""
    code = "def sysCall_init():\n" + "".join(f"    {line}\n" for line in body.strip("\n").splitlines())
    run = run_script(tmp_path, code, "--strict")
    assert run.stdout.endswith("done\n")
    assert run.returncode == 0


def test_a_program_that_is_not_there_is_a_warning_and_minus_one(tmp_path: Path) -> None:
    run = run_script(tmp_path, "def sysCall_init():\n    print(sim.launchExecutable('no_such_program'))\n", "--strict")
    assert run.stdout == "-1\n"
    assert run.returncode == 0
    assert "warning: /Ball: sim.launchExecutable: program 'no_such_program' not found in " in run.stderr
