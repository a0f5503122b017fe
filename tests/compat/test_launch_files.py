# SPDX-License-Identifier: BSD-3-Clause
"""Launch files made for Gazebo start the simulator, add robots from xacro, and find Gazebo's services."""

import subprocess
from collections.abc import Iterator
from pathlib import Path

import pytest

from launch_support import launched, with_packages
from node_support import write
from ros_support import RosCore, wait_until
from service_caller import ServiceCaller

LAUNCH = """\
<launch>
  <arg name="x" default="1"/>
  <include file="$(find gazebo_ros)/launch/empty_world.launch">
    <arg name="gui" value="false"/>
    <arg name="paused" value="true"/>
    <arg name="use_sim_time" value="0.1"/>
    <arg name="headless" value="true"/>
    <arg name="debug" value="false"/>
    <arg name="physics" value="ode"/>
    <arg name="verbose" value="true"/>
    <arg name="extra_gazebo_args" value="--speed max"/>
  </include>
  <param name="robot_description" command="$(find xacro)/xacro --inorder $(find box_robot)/box.urdf.xacro size:=0.5"/>
  <node name="spawn" pkg="gazebo_ros" type="spawn_model"
        args="-urdf -param robot_description -model crate -x $(arg x) -y 2 -z 3 -Y 1.5707963 -J hinge 0.5"/>
</launch>
"""
XACRO = """\
<robot name="box" xmlns:xacro="http://www.ros.org/wiki/xacro">
  <xacro:arg name="size" default="1"/>
  <xacro:property name="size" value="$(arg size)"/>
  <link name="base">
    <inertial><mass value="1"/><inertia ixx="1" iyy="1" izz="1" ixy="0" ixz="0" iyz="0"/></inertial>
    <collision><geometry><box size="${size} ${size} ${size}"/></geometry></collision>
  </link>
  <link name="lid">
    <inertial><mass value="1"/><inertia ixx="1" iyy="1" izz="1" ixy="0" ixz="0" iyz="0"/></inertial>
  </link>
  <joint name="hinge" type="revolute">
    <parent link="base"/><child link="lid"/><axis xyz="0 0 1"/><limit lower="-1" upper="1" effort="1" velocity="1"/>
  </joint>
</robot>
"""
MANIFEST = "<package format='2'><name>box_robot</name><version>1.0.0</version><description>A box.</description>\n\
<maintainer email='a@b.c'>me</maintainer><license>BSD</license></package>"


@pytest.fixture(scope="module")
def robot(tmp_path_factory: pytest.TempPathFactory) -> Iterator[tuple[RosCore, ServiceCaller, Path]]:
    folder = tmp_path_factory.mktemp("robot")
    (folder / "box_robot" / "launch").mkdir(parents=True)
    write(folder / "box_robot" / "package.xml", MANIFEST)
    write(folder / "box_robot" / "box.urdf.xacro", XACRO)
    write(folder / "box_robot" / "launch" / "box.launch", LAUNCH)
    with RosCore(folder / "roslog") as core:
        env = with_packages(core.env, folder)
        ready = "/gazebo/link_states"
        with (
            launched(core, env, folder / "log", "box_robot", "box.launch", ready=ready) as log,
            ServiceCaller(core) as call,
        ):
            wait_until(lambda: "crate" in call("/gazebo/get_world_properties")["model_names"], "the robot")
            yield core, call, log


def test_a_launch_file_adds_its_robot_where_it_states(robot: tuple[RosCore, ServiceCaller, Path]) -> None:
    _, call, _ = robot
    pose = call("/gazebo/get_model_state", model_name="crate")["pose"]
    assert [pose["position"][axis] for axis in "xyz"] == pytest.approx([1, 2, 3])
    assert pose["orientation"]["z"] == pytest.approx(0.5**0.5, abs=1e-6)
    assert pose["orientation"]["w"] == pytest.approx(0.5**0.5, abs=1e-6)


def test_initial_positions_of_joints_are_set(robot: tuple[RosCore, ServiceCaller, Path]) -> None:
    _, call, _ = robot
    wait_until(
        lambda: call("/gazebo/get_joint_properties", joint_name="crate::hinge")["position"] == [pytest.approx(0.5)],
        "the position of the joint",
    )


def test_properties_of_a_model_are_listed(robot: tuple[RosCore, ServiceCaller, Path]) -> None:
    _, call, _ = robot
    properties = call("/gazebo/get_model_properties", model_name="crate")
    assert properties["success"]
    assert properties["body_names"] == ["base", "lid"]
    assert properties["joint_names"] == ["hinge"]
    assert not properties["is_static"]


def test_an_unknown_joint_is_refused_with_those_that_are_there(robot: tuple[RosCore, ServiceCaller, Path]) -> None:
    _, call, _ = robot
    answer = call("/gazebo/set_model_configuration", model_name="crate", joint_names=["hing"], joint_positions=[0.1])
    assert not answer["success"]
    assert "hinge" in answer["status_message"]


def test_the_node_gazebo_has_no_service_twice(robot: tuple[RosCore, ServiceCaller, Path]) -> None:
    core, call, log = robot
    assert call("/gazebo/reset_simulation") is None  # std_srvs/Empty
    assert core.state()["services"]["/gazebo/reset_simulation"] == ["/gazebo"]
    assert "already advertised" not in log.read_text()


def test_worlds_and_arguments_of_gazebo_are_understood(tmp_path: Path) -> None:
    from bubblesim.compat.gzserver import node_command

    world = write(tmp_path / "my.world", "<sdf version='1.6'><world name='w'/></sdf>")
    command = node_command(["-u", "-e", "ode", "--verbose", "--seed", "3", str(world), "__name:=gz"], [], window=False)
    assert command[1:] == [str(world), "--gazebo-compat", "--paused", "--seed", "3", "__name:=gz"]
    command = node_command(["worlds/empty.world", "--speed", "2"], ["--speed", "max"], window=True)
    assert command[1].endswith("/worlds/empty.world")
    assert command[2:] == ["--gazebo-compat", "--speed", "2", "--web", "--speed", "max", "__name:=gazebo"]


def test_a_missing_world_is_an_error_that_states_where_it_was_searched(roscore: RosCore) -> None:
    run = subprocess.run(
        ["rosrun", "gazebo_ros", "gzserver", "worlds/nowhere.world"],
        env={**roscore.env, "GAZEBO_RESOURCE_PATH": "/tmp/mine"},
        capture_output=True,
        text=True,
        timeout=60,
        check=False,
    )
    assert run.returncode == 2
    assert "worlds/nowhere.world not found" in run.stderr
    assert "/tmp/mine" in run.stderr


def test_the_packages_are_listed(roscore: RosCore, tmp_path: Path) -> None:
    mine = tmp_path / "mine" / "joy"
    mine.mkdir(parents=True)
    write(mine / "package.xml", MANIFEST.replace("box_robot", "joy"))
    env = with_packages(roscore.env, tmp_path / "mine")
    run = subprocess.run(["bubblesim", "compat"], env=env, capture_output=True, text=True, timeout=60, check=True)
    lines = {line.split()[0]: line for line in run.stdout.splitlines()}
    assert "spawn_model" in lines["gazebo_ros"]
    assert str(mine) in lines["joy"]
    assert "not found" not in run.stdout
