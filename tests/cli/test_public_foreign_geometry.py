# SPDX-License-Identifier: BSD-3-Clause
"""Public files of CoppeliaSim: poses, masses and boxes are those of a second reader; `convert` keeps the scene."""

import xml.etree.ElementTree as ElementTree
from collections import defaultdict
from collections.abc import Iterator
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np
import pytest

import bubblesim
from cli_support import bubblesim as program
from public_foreign_files import cases, matrix, needs_files
from ttt_reader import FileObject, FilePart, roots

pytestmark = needs_files

SHORT = 20
"""Files that the usual run takes."""
PLANE, SPHEROID, CYLINDER, CAPSULE = 1, 4, 5, 8
NOT_RESPONDABLE, NOT_VISIBLE = 0x40, 0x100
THICKNESS = 0.01
"""m, of planes, which have none in the file; downward."""


@dataclass
class Placed:
    """An object of the file with its counterpart here."""

    described: FileObject
    handle: int
    world: np.ndarray
    flags: int


def placed(file: Path, world: bubblesim._core.World) -> Iterator[Placed]:
    """Walk through both trees, which must have the same objects."""

    def walk(described: list[FileObject], above: np.ndarray, flags: int, handles: list[int]) -> Iterator[Placed]:
        # A model gets a floor, which is no object of the file.
        handles = [handle for handle in handles if world.alias(handle) != "ground_plane"]
        assert len(handles) == len(described)
        for each, handle in zip(described, handles, strict=True):
            here = above @ each.frame
            yield Placed(each, handle, here, flags | each.flags)
            yield from walk(each.children, here @ each.motion, flags | each.flags, world.children(handle))

    return walk(roots(file), np.eye(4), 0, world.children(-1))


@pytest.mark.parametrize("file", cases(SHORT))
def test_objects_are_where_the_file_has_them(file: Path) -> None:
    world = bubblesim.Simulation(str(file)).world
    frames = bubblesim._core.ObjectFrames(world)
    for each in placed(file, world):
        assert np.abs(matrix(frames.pose(each.handle)) - each.world).max() < 1e-6, world.path(each.handle)


@pytest.mark.parametrize("file", cases(SHORT))
def test_the_masses_are_those_of_the_file(file: Path) -> None:
    world = bubblesim.Simulation(str(file)).world
    moving = [model for model in world.models if not world.is_static(model)]
    joints = [joint for model in moving for joint in world.parts(model, "joint")]
    held = {world.joint_links(joint)[1] for joint in joints if world.joint_links(joint)[0] < 0}
    bodies = {each.handle: each.described.mass for each in placed(file, world) if each.described.mass is not None}
    links = {link for model in moving for link in world.parts(model, "link")}
    assert links - held <= set(bodies)
    assert sum(world.mass(link) for link in links & set(bodies)) == pytest.approx(sum(bodies.values()), rel=1e-6)


@dataclass
class Boxes:
    """What a link collides with and shows, in the world of the file."""

    collisions: list[tuple[FilePart, np.ndarray]] = field(default_factory=list)
    visuals: list[tuple[FilePart, np.ndarray]] = field(default_factory=list)


def corners(
    parts: list[tuple[FilePart, np.ndarray]], link: np.ndarray, rolls: bool = False
) -> tuple[np.ndarray, float]:
    """Return the lower and the upper corner in the frame of a link, and how far the vertices may be within the shape.

    The vertices of a round shape are on its surface: of 16 around it, the farthest are within 2 % of the radius.
    """
    into = np.linalg.inv(link)
    low, high, slack = np.full(3, np.inf), np.full(3, -np.inf), 0.0
    for part, world in parts:
        points = [part.points]
        if part.primitive == PLANE:
            points.append(part.points - THICKNESS * part.up)
        if part.primitive in (SPHEROID, CYLINDER, CAPSULE):
            slack = max(slack, 0.02 * float(np.ptp(part.points, axis=0).max()) / 2)
        if rolls and part.primitive == CYLINDER:  # a wheel rolls on a sphere of its radius
            centre = (part.points.max(axis=0) + part.points.min(axis=0)) / 2
            radius = np.linalg.norm(np.cross(part.points - centre, part.up), axis=1).max()
            points.append(np.array([centre + radius * part.up, centre - radius * part.up]))
        here = into @ world
        all_points = np.concatenate(points) @ here[:3, :3].T + here[:3, 3]
        low, high = np.minimum(low, all_points.min(axis=0)), np.maximum(high, all_points.max(axis=0))
    return np.array([low, high]), slack


def element_pose(element: ElementTree.Element) -> np.ndarray:
    text = element.findtext("pose")
    return np.eye(4) if text is None else matrix([float(number) for number in text.split()])


CORNERS = np.array(np.meshgrid([-1, 1], [-1, 1], [-1, 1])).reshape(3, -1).T
TURNS = np.linspace(0, 2 * np.pi, 128)
CIRCLE = np.stack([np.cos(TURNS), np.sin(TURNS), 0 * TURNS], axis=1)
BALL = np.concatenate([CIRCLE * np.cos(up) + [0, 0, np.sin(up)] for up in TURNS - np.pi])


def points_of(geometry: ElementTree.Element, folder: Path) -> np.ndarray:
    """Return corners of a shape of SDFormat; of a round one, many points."""

    def number(name: str) -> float:
        return float(geometry.findtext(name) or "nan")

    kind = geometry[0].tag
    if kind == "mesh":
        lines = (folder / (geometry.findtext("mesh/uri") or "")).read_text().splitlines()
        return np.array([[float(n) for n in line.split()[1:]] for line in lines if line.startswith("v ")])
    if kind == "box":
        return CORNERS * np.array([float(size) for size in (geometry.findtext("box/size") or "").split()]) / 2
    if kind == "ellipsoid":
        return BALL * np.array([float(radius) for radius in (geometry.findtext("ellipsoid/radii") or "").split()])
    radius = number(f"{kind}/radius")
    if kind == "sphere":
        return BALL * radius
    ends = np.array([0, 0, number(f"{kind}/length") / 2])
    outline = radius * (BALL if kind == "capsule" else CIRCLE)
    return np.concatenate([outline - ends, outline + ends])


def shown(link: ElementTree.Element, folder: Path) -> np.ndarray | None:
    """Return the corners of the box of the visuals of a link, in its frame."""
    points = []
    for visual in link.findall("visual"):
        geometry = visual.find("geometry")
        assert geometry is not None
        pose = element_pose(visual)
        points.append(points_of(geometry, folder) @ pose[:3, :3].T + pose[:3, 3])
    if not points:
        return None
    return np.array([np.concatenate(points).min(axis=0), np.concatenate(points).max(axis=0)])


@pytest.mark.parametrize("file", cases(SHORT))
def test_shapes_have_the_boxes_of_their_vertices(file: Path, cache: Path) -> None:
    world = bubblesim.Simulation(str(file)).world
    (scene,) = cache.glob("bubblesim/converted/*/scene.sdf")
    document = ElementTree.parse(scene).getroot()
    carriers = {each.get("name"): each.findtext("link") for each in document.iter("{https://bubblesim}object")}
    elements = {each.get("name"): each for each in document.findall("world/model/link")}
    handles = {world.name(link): link for model in world.models for link in world.parts(model, "link")}
    boxes: dict[str, Boxes] = defaultdict(Boxes)
    wheels = set()
    for each in placed(file, world):
        if (shape := each.described.shape) is None:
            continue
        is_link = world.kind(each.handle) == "link"
        link = world.name(each.handle) if is_link else carriers[world.name(each.handle)]
        assert link is not None
        parts = [(part, each.world) for part in shape.parts if len(part.points)]
        if shape.is_respondable and not each.flags & NOT_RESPONDABLE:
            boxes[link].collisions += parts
        if each.described.is_visible and not each.flags & NOT_VISIBLE:
            boxes[link].visuals += [(part, pose) for part, pose in parts if not part.is_wireframe]
        if is_link and world.parent(each.handle) >= 0 and world.kind(world.parent(each.handle)) == "joint":
            wheels.add(link)
    for link, box in boxes.items():
        pose = world.pose(handles[link])
        found = world.bounds([handles[link]], pose)
        assert (found is None) == (not box.collisions), link
        if found is not None:
            expected = [corners(box.collisions, matrix(pose), rolls) for rolls in (False, link in wheels)]
            # The engine has meshes in single precision, in the world.
            far = np.linalg.norm(pose[:3])
            assert any(close(np.array(found), *each, far) for each in expected), (link, found, expected)
        seen = shown(elements[link], scene.parent)
        assert (seen is None) == (not box.visuals), link
        if seen is not None:
            expected_view, slack = corners(box.visuals, matrix(pose))
            assert close(seen, expected_view, slack), (link, seen, expected_view)


def close(found: np.ndarray, expected: np.ndarray, slack: float, far: float = 0) -> bool:
    allowed = 1e-6 * max(1, float(np.abs(expected).max()), far) + slack
    return bool(np.abs(found - expected).max() < allowed)


@pytest.mark.parametrize("file", cases(SHORT))
def test_what_convert_writes_is_the_same_scene(file: Path, tmp_path: Path) -> None:
    run = program("convert", file, tmp_path / "converted")
    assert run.returncode == 0, run.stderr
    direct, converted = bubblesim.Simulation(str(file)), bubblesim.Simulation(str(tmp_path / "converted/scene.sdf"))
    assert direct.state_hash() == converted.state_hash()
    for simulation in (direct, converted):
        simulation.step(5)
    assert direct.state_hash() == converted.state_hash()
