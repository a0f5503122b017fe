# SPDX-License-Identifier: BSD-3-Clause
"""Robots in xacro: the features of current files, and arguments from the command line."""

from pathlib import Path

import pytest

import bubblesim
from cli_support import bubblesim as command
from node_support import Node, run_sim
from ros_support import RosCore, wait_until

ROBOT = """\
<robot name="bot" xmlns:xacro="http://www.ros.org/wiki/xacro">
  <xacro:arg name="radius" default="0.5"/>
  <xacro:arg name="file" default="/none"/>
  <xacro:include filename="$(find bot_description)/urdf/sizes.xacro" ns="sizes"/>
  <xacro:property name="masses" value="${xacro.load_yaml('$(find bot_description)/config/masses.yaml')}"/>
  <link name="base">
    <inertial>
      <mass value="${masses['base'] * sizes.factor}"/>
      <inertia ixx="1" iyy="1" izz="1" ixy="0" ixz="0" iyz="0"/>
    </inertial>
    <collision><geometry><sphere radius="$(arg radius)"/></geometry></collision>
  </link>
</robot>
"""
SIZES = """\
<robot xmlns:xacro="http://www.ros.org/wiki/xacro">
  <xacro:property name="factor" value="${xacro.dotify(dict(two=2)).two}"/>
</robot>
"""


@pytest.fixture
def robot(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A robot in its own package, found by ROS_PACKAGE_PATH."""
    package = tmp_path / "ws" / "bot_description"
    for name, text in {
        "package.xml": "<package><name>bot_description</name></package>",
        "urdf/bot.urdf.xacro": ROBOT,
        "urdf/sizes.xacro": SIZES,
        "config/masses.yaml": "base: 3\n",
    }.items():
        (package / name).parent.mkdir(parents=True, exist_ok=True)
        (package / name).write_text(text)
    monkeypatch.setenv("ROS_PACKAGE_PATH", str(tmp_path / "ws"))
    return package / "urdf" / "bot.urdf.xacro"


def radius(simulation: bubblesim.Simulation) -> float:
    return float(next(shape.size[0] for shape in simulation.collisions if shape.kind == "sphere"))


def test_packages_yaml_namespaces_and_arguments(robot: Path) -> None:
    assert radius(bubblesim.Simulation(str(robot))) == 0.5
    assert radius(bubblesim.Simulation(str(robot), arguments={"radius": "0.25"})) == 0.25


def test_the_package_around_the_file_is_found_without_a_path(robot: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("ROS_PACKAGE_PATH", "/nowhere")
    assert radius(bubblesim.Simulation(str(robot))) == 0.5


def test_a_package_that_is_missing_is_named(robot: Path) -> None:
    robot.write_text(ROBOT.replace("find bot_description)/config", "find other)/config"))
    with pytest.raises(bubblesim.SceneError, match="package 'other' not found"):
        bubblesim.Simulation(str(robot))


def test_check_takes_arguments(robot: Path) -> None:
    assert command("check", robot).stdout == f"{robot}: fine\n"
    bad = command("check", robot, "radius:=-1")
    assert (bad.returncode, "the sphere's radius is -1 m" in bad.stdout) == (2, True)
    unused = command("check", "ball", "radius:=1")
    assert (unused.returncode, "argument of .xacro files" in unused.stderr) == (2, True)


def test_the_node_and_run_take_arguments(robot: Path) -> None:
    options = ["--no-ros", "--speed", "max", "--until", "0.1"]
    for run in (run_sim(robot, "radius:=-1", *options), command("run", robot, "radius:=-1", *options)):
        assert (run.returncode, "the sphere's radius is -1 m" in run.stderr) == (2, True)
    assert run_sim(robot, "radius:=0.25", *options).returncode == 0


def test_remappings_work_beside_arguments_that_are_no_names(robot: Path, roscore: RosCore, tmp_path: Path) -> None:
    arguments = [str(robot), "radius:=0.25", "file:=/a/b.yaml", "__name:=other", "/simulationTime:=/other/time"]
    with Node(roscore.env, tmp_path / "log", *arguments):
        wait_until(lambda: "/other" in roscore.state()["publishers"].get("/other/time", []), "the remapped topic")


@pytest.mark.parametrize("expression", ["open('made', 'w')", "__import__('os').mkdir('made')", "().__class__"])
def test_an_expression_in_a_file_runs_no_code(tmp_path: Path, expression: str) -> None:
    file = tmp_path / "robot.urdf.xacro"
    text = '<robot name="r" xmlns:xacro="http://ros.org/wiki/xacro"><link name="${%s}"/></robot>'
    file.write_text(text % expression)
    run = command("check", file, cwd=tmp_path)
    assert (run.returncode, "xacro" in run.stdout + run.stderr) == (2, True)
    assert not (tmp_path / "made").exists()
