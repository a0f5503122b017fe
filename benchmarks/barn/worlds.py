# SPDX-License-Identifier: BSD-3-Clause
"""The worlds of the BARN challenge (github.com/Daffan/the-barn-challenge), read from a folder on this machine.

The folder has world_N.world and path_files/path_N.npy. Frame: that of the worlds, x to the right, y to the goal, m.
"""

import functools
import os
import tempfile
import xml.etree.ElementTree as ElementTree
from pathlib import Path

import numpy as np

START = (-2.25, 3.0, 1.57)  # x, y, yaw
GOAL = (-2.25, 13.0)
SPEED = 2.0  # m/s, of the optimal time: the maximum of the robot

_CYLINDER = """<collision name="cylinder{number}"><pose>{pose}</pose>
  <geometry><cylinder><radius>{radius}</radius><length>{length}</length></cylinder></geometry>
  <surface><contact><collide_bitmask>2</collide_bitmask></contact></surface></collision>"""
_SCENE = """<?xml version="1.0"?>
<sdf version="1.9" xmlns:bubblesim="https://bubblesim">
  <world name="barn">
    <physics name="default" type="ode"><max_step_size>0.005</max_step_size></physics>
    <bubblesim:time_step>0.05</bubblesim:time_step>
    <model name="ground"><static>true</static><link name="link"><collision name="plane">
      <geometry><plane><normal>0 0 1</normal><size>100 100</size></plane></geometry>
      <surface><contact><collide_bitmask>1</collide_bitmask></contact></surface>
    </collision></link></model>
    <model name="obstacles"><static>true</static><link name="link">{cylinders}</link></model>
    <include><uri>file://{robot}</uri><pose>{x} {y} 0 0 0 {yaw}</pose></include>
  </world>
</sdf>
"""


def folder() -> Path:
    """Return the folder of the worlds, from the environment."""
    named = os.environ.get("BARN_WORLDS", "")
    if not Path(named, "world_0.world").is_file():
        raise FileNotFoundError(
            f"BARN_WORLDS is '{named}': set it to the folder of the challenge that has world_0.world and path_files/"
        )
    return Path(named)


def optimal_time(world: int) -> float:
    """Return the time, s, at full speed on the challenge's reference path, with start and goal as its ends."""
    cells = np.load(folder() / "path_files" / f"path_{world}.npy")
    points = np.column_stack([cells[:, 0] * 0.15 - 4.575, cells[:, 1] * 0.15 + 5.075])
    points = np.vstack([START[:2], points, GOAL])
    return float(np.linalg.norm(np.diff(points, axis=0), axis=1).sum() / SPEED)


@functools.cache
def scene_of(world: int) -> str:
    """Write a scene with the obstacles of a world and the robot at the start; return its path."""
    cylinders = []
    for model in ElementTree.parse(folder() / f"world_{world}.world").getroot().iterfind("./world/model"):
        cylinder = model.find("./link/collision/geometry/cylinder")
        if cylinder is not None:
            cylinders.append(
                _CYLINDER.format(
                    number=len(cylinders),
                    pose=model.findtext("pose", "0 0 0 0 0 0"),
                    radius=cylinder.findtext("radius"),
                    length=cylinder.findtext("length"),
                )
            )
    x, y, yaw = START
    robot = Path(__file__).resolve().parent / "jackal.sdf"
    file = Path(_temporary().name, f"world_{world}.sdf")
    file.write_text(_SCENE.format(cylinders="\n".join(cylinders), robot=robot, x=x, y=y, yaw=yaw))
    return str(file)


@functools.cache
def _temporary() -> "tempfile.TemporaryDirectory[str]":
    return tempfile.TemporaryDirectory(prefix="bubblesim-barn-")
