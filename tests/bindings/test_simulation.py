# SPDX-License-Identifier: BSD-3-Clause
"""bubblesim.Simulation from Python: stepping, objects, errors."""

import gc
import re
import subprocess
import threading
import time
import weakref
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import bubblesim
from interrupted_program import errors_of_interrupted
from node_support import clean_environment, endless_fall
from ros_support import REPOSITORY


@pytest.fixture
def tricycle() -> bubblesim.Simulation:
    return bubblesim.Simulation("tricycle", seed=1)


def run_python(code: str, **environment: str) -> str:
    """Return the output of a separate process."""
    env = clean_environment(PYTHONPATH=str(Path(bubblesim.__file__).parents[1]), PATH="/usr/bin:/bin", **environment)
    return subprocess.run(["/usr/bin/python3", "-c", code], env=env, capture_output=True, text=True, check=True).stdout


def test_time_advances_by_steps(tricycle: bubblesim.Simulation) -> None:
    assert (tricycle.time, tricycle.time_step, tricycle.seed) == (0.0, 0.05, 1)
    tricycle.step()
    tricycle.step(19)
    tricycle.step(0)
    assert tricycle.time == pytest.approx(1.0)


@pytest.mark.parametrize(
    ("steps", "error"), [(-1, ValueError), (2**64, ValueError), (1.5, TypeError), ("2", TypeError)]
)
@pytest.mark.parametrize(
    "make",
    [
        lambda: bubblesim.Simulation("ball"),
        lambda: bubblesim.Batch("ball", 1),
        lambda: bubblesim.Runner(bubblesim.Simulation("ball")),
    ],
)
def test_what_is_no_number_of_steps_is_refused(make: Callable[[], Any], steps: Any, error: type[Exception]) -> None:
    text = (
        f"steps={steps!r} is not a number of simulation steps: pass a whole number, 0 or more; for a time in seconds, "
    )
    with pytest.raises(error, match=re.escape(text)):
        make().step(steps=steps)


def test_poses_are_arrays_of_doubles(tricycle: bubblesim.Simulation) -> None:
    body = tricycle.object("/Tricycle")
    np.testing.assert_allclose(body.position, [-2.5, -1.2, 0])
    np.testing.assert_allclose(body.orientation, [0, 0, 0, 1])
    for array, size in (
        (body.position, 3),
        (body.orientation, 4),
        (body.linear_velocity, 3),
        (body.angular_velocity, 3),
    ):
        assert array.shape == (size,)
        assert array.dtype == np.float64


def test_what_is_set_is_read_back() -> None:
    ball = bubblesim.Simulation("ball").object("/Ball")
    ball.position = [1, 2, 3]
    ball.orientation = np.array([0, 0, 1, 0], dtype=np.float32)
    ball.linear_velocity = (4, 5, 6)
    ball.angular_velocity = np.array([7, 8, 9])
    np.testing.assert_allclose(ball.position, [1, 2, 3])
    np.testing.assert_allclose(np.abs(ball.orientation), [0, 0, 1, 0])
    np.testing.assert_allclose(ball.linear_velocity, [4, 5, 6])
    np.testing.assert_allclose(ball.angular_velocity, [7, 8, 9])


def test_a_read_array_is_a_copy() -> None:
    ball = bubblesim.Simulation("ball").object("/Ball")
    ball.position[:] = 9
    np.testing.assert_allclose(ball.position, [-1.5, 0, 0.4])


def test_joints_are_driven(tricycle: bubblesim.Simulation) -> None:
    steering, motor = tricycle.object("/Steering"), tricycle.object("/FrontMotor")
    steering.target_position = 0.3
    motor.target_velocity = 2.0
    motor.max_force = 40.0
    tricycle.step(40)
    assert steering.joint_position == pytest.approx(0.3, abs=1e-3)
    assert motor.joint_velocity == pytest.approx(2.0, abs=1e-2)
    assert (steering.target_position, motor.target_velocity, motor.max_force) == (0.3, 2.0, 40.0)


def test_an_axis_gets_a_motor_until_the_world_is_reset() -> None:
    simulation = bubblesim.Simulation("ball")
    simulation.add_model(
        """<sdf version="1.9"><model name="fan"><static>false</static>
        <link name="stand"><inertial><mass>100</mass></inertial></link>
        <link name="wheel"><pose>0 0 1 0 0 0</pose></link>
        <joint name="foot" type="fixed"><parent>world</parent><child>stand</child></joint>
        <joint name="hub" type="revolute"><parent>stand</parent><child>wheel</child><axis><xyz>0 0 1</xyz>
        <dynamics><damping>0.1</damping></dynamics></axis></joint></model></sdf>"""
    )
    world = simulation.world
    hub = simulation.object("/hub").handle
    names = [world.name(handle) for handle in world.joint_links(hub)]
    assert (names, world.joint_axes(hub)) == (["stand", "wheel"], 1)
    world.set_target_velocity(hub, 3.0)
    simulation.step()
    assert world.joint_velocity(hub) == 0.0, "it has no motor"
    world.set_motor_mode(hub, bubblesim._core.MotorMode.VELOCITY)
    simulation.step(2)
    assert world.joint_velocity(hub) == pytest.approx(3.0)
    world.set_motor_mode(hub, bubblesim._core.MotorMode.POSITION)
    world.set_target_position(hub, 1.0)
    simulation.step(40)
    assert world.joint_position(hub) == pytest.approx(1.0, abs=1e-3)
    simulation.reset()
    world.set_target_velocity(hub, 3.0)
    simulation.step()
    assert world.joint_velocity(hub) == 0.0


def test_objects_know_their_place(tricycle: bubblesim.Simulation) -> None:
    sonar = tricycle.object("/FrontSonar")
    assert (sonar.name, sonar.kind, sonar.path) == ("FrontSonar", "sensor", "/Tricycle/base_link/FrontSonar")
    assert sonar.parent.path == "/Tricycle/base_link"
    assert tricycle.object("/Tricycle").parent is None
    assert sonar.path in [thing.path for thing in tricycle.objects]
    assert "/FrontSonar (sensor)" in repr(sonar)


def test_a_sonar_reads_in_its_own_frame(tricycle: bubblesim.Simulation) -> None:
    body, sonar = tricycle.object("/Tricycle"), tricycle.object("/FrontSonar")
    assert not sonar.reading.detected
    assert sonar.reading.distance == 0
    body.position = [-3.5, -1.2, 0]
    body.orientation = [0, 0, 1, 0]  # turns to the wall behind it
    tricycle.step()
    reading = sonar.reading
    assert reading.detected
    assert np.linalg.norm(reading.point) == pytest.approx(reading.distance)
    assert np.linalg.norm(reading.normal) == pytest.approx(1)
    assert reading.handle >= 0


def test_collision_shapes_return_their_poses() -> None:
    shapes = {shape.object_path: shape for shape in bubblesim.Simulation("ball").collisions}
    ball, board, floor = shapes["/Ball/link"], shapes["/Ramp/link"], shapes["/Floor/link"]
    assert (ball.kind, ball.size, ball.is_static) == ("sphere", [0.1], False)
    assert (board.kind, board.size, board.is_static) == ("box", [1.5, 0.6, 0.05], True)
    assert (floor.kind, floor.size) == ("plane", [0, 0, 1])
    np.testing.assert_allclose(ball.position, [-1.5, 0, 0.4])
    np.testing.assert_allclose(board.orientation, [0, np.sin(0.1), 0, np.cos(0.1)])


def test_objects_outlive_the_name_of_their_simulation() -> None:
    ball = bubblesim.Simulation("ball").object("/Ball")
    world = bubblesim.Simulation("ball").world
    gc.collect()
    np.testing.assert_allclose(ball.position, [-1.5, 0, 0.4])
    assert world.path(world.find("/Ball")) == "/Ball"


def test_the_wind_keeps_its_simulation() -> None:
    simulation = bubblesim.Simulation("ball")
    reference, wind = weakref.ref(simulation), simulation.wind
    del simulation
    gc.collect()
    assert reference() is not None
    np.testing.assert_array_equal(wind.velocity, [0, 0, 0])


@pytest.mark.parametrize(
    ("name", "value", "text"),
    [
        ("position", [1, 2], "position: expected 3 numbers, found 2"),
        ("position", [[1, 2, 3]], "position: expected 3 numbers, found 1 x 3"),
        ("position", 5.0, "position: expected 3 numbers, found a single value"),
        ("position", [1, 2, np.nan], "finite"),
        ("position", [1e9, 0, 0], "within 1e6 m"),
        ("orientation", [0, 0, 0, 0], "uaternion"),
        ("linear_velocity", [1e9, 0, 0], "at most 1e6"),
        ("target_velocity", 1.0, "/Ball is a model, not a joint"),
    ],
)
def test_bad_values_are_refused_and_change_nothing(name: str, value: object, text: str) -> None:
    simulation = bubblesim.Simulation("ball")
    before = simulation.state_hash()
    with pytest.raises((ValueError, bubblesim.NoSuchObject), match=text):
        setattr(simulation.object("/Ball"), name, value)
    assert simulation.state_hash() == before


def test_unknown_objects_are_named_with_similar_ones(tricycle: bubblesim.Simulation) -> None:
    with pytest.raises(bubblesim.NoSuchObject, match="'/FrontMoter'; did you mean /FrontMotor") as caught:
        tricycle.object("/FrontMoter")
    assert isinstance(caught.value, LookupError)


def test_a_bad_scene_reports_all_its_problems(tmp_path: Path) -> None:
    text = (REPOSITORY / "scenes" / "ball.sdf").read_text()
    bad = tmp_path / "bad.sdf"
    text = text.replace("<mass>0.5</mass>", "<mass>-1</mass>").replace("<radius>0.1</radius>", "<radius>-2</radius>")
    bad.write_text(text.replace(">ball.py<", ">nothing.py<"))
    with pytest.raises(bubblesim.SceneError) as caught:
        bubblesim.Simulation(str(bad))
    for part in ("nothing.py", "mass", "radius"):
        assert any(part in line and f"{bad}:" in line for line in str(caught.value).splitlines()), str(caught.value)


def test_diverging_is_an_exception_of_its_own(tmp_path: Path) -> None:
    simulation = bubblesim.Simulation(str(endless_fall(tmp_path)))
    with pytest.raises(bubblesim.Diverged, match="/Ball"):
        simulation.step(1000)


def test_other_threads_run_while_it_steps() -> None:
    simulation = bubblesim.Simulation("ball")
    stepping = threading.Thread(target=simulation.step, args=(200_000,))
    stepping.start()
    counted = 0
    while stepping.is_alive():
        counted += 1
        time.sleep(0)
    stepping.join()
    assert counted > 1000


def test_ctrl_c_ends_a_long_call() -> None:
    code = "import bubblesim; s = bubblesim.Simulation('ball'); print('ready', flush=True); s.step(10**12)"
    assert "KeyboardInterrupt" in errors_of_interrupted(code)


HASH = """
import bubblesim
s = bubblesim.Simulation("tricycle", seed=7)
s.object("/Steering").target_position = 0.4
s.object("/FrontMotor").target_velocity = 3.0
s.step(200)
print(s.state_hash())
"""


def test_equal_seeds_give_equal_states_in_20_runs_and_2_processes() -> None:
    def state_hash() -> int:
        simulation = bubblesim.Simulation("tricycle", seed=7)
        simulation.object("/Steering").target_position = 0.4
        simulation.object("/FrontMotor").target_velocity = 3.0
        simulation.step(200)
        return int(simulation.state_hash())

    hashes = {state_hash() for _ in range(20)} | {int(run_python(HASH)) for _ in range(2)}
    assert len(hashes) == 1


def test_a_reset_starts_it_again() -> None:
    simulation = bubblesim.Simulation("tricycle", seed=7)
    motor = simulation.object("/FrontMotor")
    start, force = simulation.state_hash(), motor.max_force
    motor.target_velocity = 3.0
    motor.max_force = 7.0
    simulation.step(20)
    simulation.reset_world()
    assert (simulation.time, motor.target_velocity, motor.max_force) == (pytest.approx(1.0), 0.0, force)
    assert simulation.state_hash() != start  # the time is a part of it
    simulation.reset()
    assert (simulation.time, simulation.state_hash()) == (0.0, start)


def test_it_needs_no_ros() -> None:
    code = (
        "import sys, bubblesim; s = bubblesim.Simulation('tricycle'); s.step(5); "
        "maps = open('/proc/self/maps').read(); "
        "print([m for m in sys.modules if m.startswith('ros')], [l for l in maps.split() if '/libros' in l])"
    )
    assert run_python(code) == "[] []\n"


def test_a_name_with_a_typo_is_answered_with_the_nearest_one() -> None:
    with pytest.raises(AttributeError, match=r"has no attribute 'Simulaton'; did you mean bubblesim\.Simulation\?"):
        bubblesim.Simulaton  # noqa: B018


def test_none_is_no_scene() -> None:
    with pytest.raises(TypeError, match="incompatible constructor arguments"):
        bubblesim.Simulation(None)
    with pytest.raises(TypeError, match="incompatible constructor arguments"):
        bubblesim.Batch(None, 1)
