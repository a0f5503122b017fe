# SPDX-License-Identifier: BSD-3-Clause
"""Models as URDF: following the joints gives the link poses of the simulation."""

import math
import subprocess
import xml.etree.ElementTree as ElementTree
from typing import Any

import numpy as np
import pytest

import bubblesim
from ros_support import REPOSITORY, built

Matrix = np.ndarray[Any, np.dtype[np.float64]]

ROBOTS = {"tricycle": "/Tricycle", "bubblerob": "/rosInterfaceControlledBubbleRob", "pioneer": "/Pioneer_p3dx"}


def about(axis: Matrix, angle: float) -> Matrix:
    """Return a rotation by Rodrigues' formula, as a 4x4 matrix."""
    x, y, z = axis
    cross = np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])
    turn = np.eye(4)
    turn[:3, :3] = np.eye(3) + math.sin(angle) * cross + (1 - math.cos(angle)) * cross @ cross
    return turn


def placed(position: Matrix, rotation: Matrix) -> Matrix:
    matrix = rotation.copy()
    matrix[:3, 3] = position
    return matrix


def origin(element: ElementTree.Element) -> Matrix:
    """Return a joint's origin: rpy rotates about x, then y, then z, all of the parent."""
    found = element.find("origin")
    assert found is not None
    roll, pitch, yaw = map(float, found.attrib["rpy"].split())
    turn = about(np.array([0, 0, 1]), yaw) @ about(np.array([0, 1, 0]), pitch) @ about(np.array([1, 0, 0]), roll)
    return placed(np.array(list(map(float, found.attrib["xyz"].split()))), turn)


def matrix_of(thing: Any) -> Matrix:
    x, y, z, w = thing.orientation
    angle = 2 * math.atan2(math.hypot(x, y, z), w)
    axis = np.array([x, y, z]) / (math.hypot(x, y, z) or 1.0)
    return placed(thing.position, about(axis, angle))


def link_of(joint: ElementTree.Element, role: str) -> str:
    found = joint.find(role)
    assert found is not None
    return found.attrib["link"]


def motion(joint: ElementTree.Element, simulation: bubblesim.Simulation, model: str) -> Matrix:
    axis = joint.find("axis")
    if axis is None:
        return np.eye(4)
    moved = simulation.object(f"{model}/{joint.attrib['name']}").joint_position
    along = np.array(list(map(float, axis.attrib["xyz"].split())))
    return placed(along * moved, np.eye(4)) if joint.attrib["type"] == "prismatic" else about(along, moved)


def follow(urdf: str, simulation: bubblesim.Simulation, model: str) -> dict[str, Matrix]:
    """Return the poses of all links in the root's frame."""
    joints = ElementTree.fromstring(urdf).findall("joint")
    (root,) = {link_of(j, "parent") for j in joints} - {link_of(j, "child") for j in joints}
    poses = {root: np.eye(4)}
    while len(poses) <= len(joints):
        for joint in joints:
            parent = link_of(joint, "parent")
            if parent in poses:
                poses[link_of(joint, "child")] = poses[parent] @ origin(joint) @ motion(joint, simulation, model)
    return poses


def check(simulation: bubblesim.Simulation, model: str, root: str) -> None:
    base = np.linalg.inv(matrix_of(simulation.object(f"{model}/{root}")))
    poses = follow(simulation.object(model).urdf, simulation, model)
    found = [o for o in simulation.objects if o.path.startswith(f"{model}/") and o.kind in ("link", "sensor")]
    assert len(found) > 1
    for thing in found:
        np.testing.assert_allclose(poses[thing.name], base @ matrix_of(thing), atol=1e-3, err_msg=thing.path)


@pytest.mark.parametrize("scene", ROBOTS)
def test_links_and_sensors_of_robots_are_where_the_joints_lead(scene: str) -> None:
    simulation = bubblesim.Simulation(scene)
    for thing in simulation.objects:
        if thing.kind == "joint":
            thing.target_velocity = 2.0
            thing.target_position = 0.4
    simulation.step(20)
    check(simulation, ROBOTS[scene], "base_link")


ARM = """<sdf version="1.9"><model name="Arm">
  <link name="base"><pose>0 0 1 0 0 0.5</pose></link>
  <link name="slide"><pose>0.1 0.2 0.9 0.3 0 0</pose></link>
  <link name="hand"><pose>0.5 0 0.7 0 0.2 0.1</pose>
    <sensor name="Eye" type="camera"><pose>0.1 0 0 0 0.3 0</pose>
      <camera><horizontal_fov>1</horizontal_fov><image><width>4</width><height>4</height></image>
        <clip><near>0.1</near><far>9</far></clip></camera></sensor></link>
  <joint name="rail" type="prismatic"><pose>0 0 0.2 0.1 0.2 0.3</pose><parent>base</parent><child>slide</child>
    <axis><xyz>0.6 0.8 0</xyz><limit><lower>-1</lower><upper>1</upper></limit></axis></joint>
  <joint name="wrist" type="revolute"><pose>0.1 0 -0.2 0 0 0.4</pose><parent>slide</parent><child>hand</child>
    <axis><xyz>0 0.6 0.8</xyz><limit><lower>-2</lower><upper>2</upper></limit></axis></joint>
</model></sdf>"""


def test_links_whose_frames_are_not_at_their_joints_are_found_as_well() -> None:
    simulation = bubblesim.Simulation("ball")
    simulation.add_model(ARM)
    simulation.step(5)  # it falls, and its joints move
    check(simulation, "/Arm", "base")
    poses = follow(simulation.object("/Arm").urdf, simulation, "/Arm")
    # An optical frame looks along z, with x to the right (REP 103).
    np.testing.assert_allclose(
        np.linalg.inv(poses["Eye"]) @ poses["Eye_optical"] @ [[1, 0, 0], [0, 1, 0], [0, 0, 1], [0, 0, 0]],
        [[0, 0, 1], [-1, 0, 0], [0, -1, 0], [0, 0, 0]],
        atol=1e-9,
    )


def test_what_urdf_cannot_describe_is_an_error() -> None:
    simulation = bubblesim.Simulation("ball")
    simulation.add_model(ARM.replace('"prismatic"', '"ball"'))
    with pytest.raises(ValueError, match="/Arm/rail: URDF has no joints of type ball"):
        _ = simulation.object("/Arm").urdf
    with pytest.raises(ValueError, match="/Room has 2 root links"):
        _ = bubblesim.Simulation("tricycle").object("/Room").urdf


def test_the_program_prints_it_or_states_what_is_wrong() -> None:
    def run(*arguments: str) -> "subprocess.CompletedProcess[str]":
        command = [str(built("robot_description")), *arguments]
        return subprocess.run(command, cwd=REPOSITORY, capture_output=True, text=True, check=False)

    assert run("pioneer", "/Pioneer_p3dx").stdout.strip() == (
        bubblesim.Simulation("pioneer").object("/Pioneer_p3dx").urdf.strip()
    )
    wrong = run("pioneer", "/Pioner_p3dx")
    assert (wrong.returncode, wrong.stdout) == (2, "")
    assert "Pioneer_p3dx" in wrong.stderr
