# SPDX-License-Identifier: BSD-3-Clause
"""Public files of CoppeliaSim, if there are any beside the project: poses, masses, and how they stand."""

import math
from pathlib import Path

import numpy as np
import pytest

import bubblesim
from ros_support import REPOSITORY
from ttt_reader import FileObject, roots


def public_files() -> list[Path]:
    folders = [folder / "shared" / "ttt" for folder in (REPOSITORY.parent, REPOSITORY.parent.parent)]
    files = [file for folder in folders for suffix in ("ttt", "ttm") for file in folder.rglob(f"*.{suffix}")]
    return sorted(file for file in set(files) if file.stat().st_size > 0)


FILES = public_files()
SMALL = 310_000
"""Bytes of files that the reader of the tests unpacks in a second."""

pytestmark = pytest.mark.skipif(not FILES, reason="no public files of CoppeliaSim are beside the project")


def named(file: Path) -> str:
    return f"{file.parent.name}/{file.name}"


@pytest.fixture(autouse=True)
def _own_cache(tmp_path_factory: pytest.TempPathFactory, monkeypatch: pytest.MonkeyPatch) -> None:
    """Keep conversions out of the user's cache."""
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path_factory.mktemp("cache")))


def matrix(pose: list[float]) -> np.ndarray:
    """Return the transformation of x y z and a quaternion x y z w."""
    x, y, z, w = pose[3:]
    made = np.eye(4)
    made[:3, :3] = [
        [1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
        [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
        [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)],
    ]
    made[:3, 3] = pose[:3]
    return made


@pytest.mark.parametrize("file", [file for file in FILES if file.stat().st_size < SMALL], ids=named)
def test_objects_are_where_the_file_has_them(file: Path) -> None:
    simulation = bubblesim.Simulation(str(file))
    world = simulation.world
    frames = bubblesim._core.ObjectFrames(world)
    mass = 0.0

    def compare(described: list[FileObject], above: np.ndarray, handles: list[int]) -> None:
        nonlocal mass
        # A model gets a floor, which is no object of the file.
        handles = [handle for handle in handles if world.alias(handle) != "ground_plane"]
        assert len(handles) == len(described)
        for each, handle in zip(described, handles, strict=True):
            here = above @ each.frame
            assert np.abs(matrix(frames.pose(handle)) - here).max() < 1e-6, world.path(handle)
            mass += each.mass or 0
            compare(each.children, here @ each.motion, world.children(handle))

    compare(roots(file), np.eye(4), world.children(-1))
    moving = [model for model in world.models if not world.is_static(model)]
    joints = [joint for model in moving for joint in world.parts(model, "joint")]
    held = {world.joint_links(joint)[1] for joint in joints if world.joint_links(joint)[0] < 0}  # what stands still
    links = [link for model in moving for link in world.parts(model, "link") if link not in held]
    assert sum(world.mass(link) for link in links) == pytest.approx(mass, rel=1e-6)


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


@pytest.mark.parametrize("file", FILES, ids=named)
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


PIONEERS = [
    file for file in FILES if file.name in ("pioneer_p3dx.ttm", "scene_pioneer.ttt", "pioneer_python_control.ttt")
]
RADIUS, TRACK = 0.0975, 0.331
"""m, of the wheels and between them, from the manufacturer's data sheet."""


@pytest.mark.parametrize("file", PIONEERS, ids=named)
def test_pioneers_drive_and_turn_by_their_kinematics(file: Path) -> None:
    simulation = bubblesim.Simulation(str(file))
    world = simulation.world
    joints = [joint for model in world.models for joint in world.parts(model, "joint")]
    left, right = (
        next(joint for joint in joints if world.alias(joint).endswith(end)) for end in ("leftMotor", "rightMotor")
    )
    base = world.joint_links(left)[0]
    speed = 3.0  # rad/s
    seconds = round(1 / simulation.time_step)
    for sign in (1, -1):  # straight, on the spot
        world.set_target_velocity(left, sign * speed)
        world.set_target_velocity(right, speed)
        simulation.step(seconds)
        before = world.pose(base)
        simulation.step(seconds)
        after = world.pose(base)
        way = math.dist(before[:2], after[:2])
        turn = (matrix(before)[:3, :3].T @ matrix(after)[:3, :3])[1, 0]
        if sign > 0:
            assert way == pytest.approx(speed * RADIUS, rel=0.01)
        else:
            assert math.asin(turn) == pytest.approx(math.pi - 2 * speed * RADIUS / TRACK, rel=0.02)
