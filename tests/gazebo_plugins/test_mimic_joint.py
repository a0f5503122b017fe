# SPDX-License-Identifier: BSD-3-Clause
"""A finger that follows another one by the plugin of roboticsgroup_gazebo_plugins."""

import math
from pathlib import Path

import pytest
from bubblesim._core import MotorMode

import bubblesim
from bubblesim.gazebo_plugins.robots import GazeboPlugins
from node_support import write

STEP = 0.01  # s
GRIPPER = """\
<sdf version="1.9" xmlns:bubblesim="https://bubblesim"><world name="w">
  <physics type="ode"><max_step_size>0.001</max_step_size></physics>
  <bubblesim:time_step>0.01</bubblesim:time_step>
  <model name="gripper">
    <link name="palm"/><link name="left"><pose>0 0.1 0 0 0 0</pose></link><link name="right"><pose>0 -0.1 0 0 0 0</pose>
    </link>
    <joint name="mount" type="fixed"><parent>world</parent><child>palm</child></joint>
    <joint name="leader" type="revolute"><parent>palm</parent><child>left</child><axis><xyz>0 0 1</xyz>
      <limit><lower>-1</lower><upper>1</upper><effort>1000</effort></limit></axis></joint>
    <joint name="follower" type="revolute"><parent>palm</parent><child>right</child><axis><xyz>0 0 1</xyz>
      <limit><lower>-1</lower><upper>1</upper><effort>1000</effort></limit></axis></joint>
    <plugin name="mimic" filename="libroboticsgroup_gazebo_mimic_joint_plugin.so">
      <joint>leader</joint><mimicJoint>follower</mimicJoint><multiplier>-0.5</multiplier><offset>0.1</offset>{more}
    </plugin>
  </model>
</world></sdf>
"""


def moved(folder: Path, more: str) -> tuple[list[float], list[float]]:
    """Return the positions of leader and follower while the leader swings."""
    simulation = bubblesim.Simulation(str(write(folder / "gripper.sdf", GRIPPER.format(more=more))))
    plugins = GazeboPlugins(simulation, None)
    world = simulation.world
    leader, follower = (world.find(f"/gripper/{name}") for name in ("leader", "follower"))
    world.set_motor_mode(leader, MotorMode.POSITION)
    found: tuple[list[float], list[float]] = ([], [])
    for number in range(300):
        world.set_target_position(leader, 0.8 * math.sin(number * STEP * 2))
        plugins.actuate()
        simulation.step()
        for positions, joint in zip(found, (leader, follower), strict=True):
            positions.append(world.joint_position(joint))
    return found


def test_it_follows_with_multiplier_and_offset(tmp_path: Path) -> None:
    leader, follower = moved(tmp_path, "")
    assert max(leader) == pytest.approx(0.8, abs=0.02)
    errors = [abs(there - (-0.5 * here + 0.1)) for here, there in zip(leader, follower, strict=True)]
    assert max(errors[50:]) < 0.01, "the turn of a step"


def test_its_effort_may_be_limited(tmp_path: Path) -> None:
    _, follower = moved(tmp_path, "<hasPID/><maxEffort>0</maxEffort>")
    assert max(map(abs, follower)) < 1e-6


def test_small_deviations_may_be_left(tmp_path: Path) -> None:
    leader, follower = moved(tmp_path, "<sensitiveness>0.2</sensitiveness>")
    errors = [abs(there - (-0.5 * here + 0.1)) for here, there in zip(leader, follower, strict=True)]
    assert 0.05 < max(errors) < 0.25
