# SPDX-License-Identifier: BSD-3-Clause
"""Gazebo models in the folder BUBBLESIM_ZOO: each loads, comes to rest, and drives."""

import os
import xml.etree.ElementTree as ElementTree
from pathlib import Path

import numpy as np
import pytest

import bubblesim

ZOO = Path(os.environ.get("BUBBLESIM_ZOO", ""))
FILES = sorted(ZOO.glob("*/*.sdf")) if "BUBBLESIM_ZOO" in os.environ else []
# Models that nothing holds: they swing.
RESTLESS = {"double_pendulum_with_base", "simple_arm"}
SETTLED = 0.05  # m/s or rad/s
MOTOR = "{https://bubblesim}motor"
ElementTree.register_namespace("bubblesim", "https://bubblesim")  # the files use this prefix

pytestmark = pytest.mark.skipif(not FILES, reason="BUBBLESIM_ZOO names no folder with models")


def name(file: Path) -> str:
    return str(file.relative_to(ZOO))


def links(simulation: bubblesim.Simulation) -> list[bubblesim.Object]:
    """Return the model's links, without the ground's."""
    return [thing for thing in simulation.objects if thing.kind == "link" and not thing.path.startswith("/ground")]


def run(simulation: bubblesim.Simulation, seconds: float) -> None:
    simulation.step(round(seconds / simulation.time_step))
    for link in links(simulation):
        assert np.isfinite([*link.position, *link.orientation, *link.linear_velocity, *link.angular_velocity]).all()
        assert link.position[2] > -0.1, f"{link.path} is below the ground"


@pytest.mark.parametrize("file", FILES, ids=map(name, FILES))
def test_it_loads_and_comes_to_rest(file: Path) -> None:
    simulation = bubblesim.Simulation(str(file))
    run(simulation, 2.0)
    if file.parent.name in RESTLESS:
        return
    for link in links(simulation):
        speed = max(np.linalg.norm(link.linear_velocity), np.linalg.norm(link.angular_velocity))
        assert speed < SETTLED, f"{link.path} still moves"


def wheels(model: ElementTree.Element) -> list[ElementTree.Element]:
    """Return the axes of the joints that turn wheels."""

    def is_wheel(joint: ElementTree.Element) -> bool:
        return "wheel" in joint.get("name", "") + (joint.findtext("child") or "")

    return [
        axis
        for joint in model.iter("joint")
        if joint.get("type") in ("revolute", "continuous") and is_wheel(joint)
        for axis in joint.findall("axis")
    ]


def has_wheels(file: Path) -> bool:
    return bool(wheels(ElementTree.parse(file).getroot()))


DRIVING = [file for file in FILES if file.name == "model.sdf" and has_wheels(file)]


@pytest.mark.parametrize("file", DRIVING, ids=map(name, DRIVING))
def test_it_drives_on_its_wheels(file: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    tree = ElementTree.parse(file)
    for axis in wheels(tree.getroot()):
        ElementTree.SubElement(axis, MOTOR).text = "velocity"
    tree.write(tmp_path / "model.sdf")
    monkeypatch.setenv("GAZEBO_MODEL_PATH", str(ZOO))
    simulation = bubblesim.Simulation(str(tmp_path / "model.sdf"))
    run(simulation, 1.0)
    start = {link.path: np.array(link.position) for link in links(simulation)}
    for thing in simulation.objects:
        if thing.kind == "joint" and ("wheel" in thing.name or thing.name.endswith(("front", "rear"))):
            thing.target_velocity = 2.0
    run(simulation, 2.0)
    moved = [float(np.linalg.norm((np.array(link.position) - start[link.path])[:2])) for link in links(simulation)]
    assert min(moved) > 0.05, f"moved {moved} m"
