# SPDX-License-Identifier: BSD-3-Clause
"""Programs that tutorials call by package names that Debian lacks, and one Debian program."""

import subprocess
from pathlib import Path

import pytest

from display_support import Display
from ros_support import DEADLINE, REPOSITORY, RosCore, start, stop, wait_until
from workspace_support import Workspace

PACKAGES = {
    "controller_manager": "spawner",
    "gazebo_ros": "spawn_model",
    "joy": "joy_node",
    "map_server": "map_server",
    "mouse_teleop": "mouse_teleop.py",
    "move_base": "move_base",
    "pointcloud_to_laserscan": "pointcloud_to_laserscan_node",
    "robot_localization": "ekf_localization_node",
    "teleop_twist_joy": "teleop_node",
    "teleop_twist_keyboard": "teleop_twist_keyboard.py",
    "twist_mux": "twist_mux",
    "xacro": "xacro",
}
PROJECT = """cmake_minimum_required(VERSION 3.18)
project(bubblesim LANGUAGES CXX)
find_package(catkin REQUIRED)
set(BUBBLESIM_BUILD_NODES ON)
add_subdirectory(compat)
catkin_package()
"""
USERS_PACKAGE = """cmake_minimum_required(VERSION 3.18)
project({name})
find_package(catkin REQUIRED)
catkin_package()
"""


@pytest.mark.parametrize("package", ["mouse_teleop", "teleop_twist_keyboard"])
def test_teleoperation_answers_to_its_tutorials_name(roscore: RosCore, package: str) -> None:
    assert "Teleoperation with the" in roscore.run("rosrun", package, PACKAGES[package], "--help")


def test_the_cloud_converter_answers_to_its_tutorials_name(roscore: RosCore) -> None:
    package = "pointcloud_to_laserscan"
    process = start(["rosrun", package, PACKAGES[package], "cloud_in:=/cloud", "scan:=/flat"], roscore.env)
    wait_until(lambda: "/flat" in roscore.state()["publishers"], "the scan's topic")
    stop(process)


def test_image_view_shows_a_topic(roscore: RosCore) -> None:
    with Display(roscore.env) as display:
        image = "{height: 64, width: 64, encoding: mono8, step: 64, data: [" + "9, " * 4095 + "9]}"
        sender = start(["rostopic", "pub", "-r", "5", "/image", "sensor_msgs/Image", image], display.env)
        viewer = start(["rosrun", "image_view", "image_view", "image:=/image"], display.env, stdout=subprocess.DEVNULL)
        wait_until(lambda: bool(display.windows("/image")), "the window", 3 * DEADLINE)
        stop(viewer)
        stop(sender)


@pytest.mark.parametrize("tool", ["catkin", "catkin_make"])
def test_packages_of_the_users_workspace_come_first(tmp_path: Path, tool: str) -> None:
    workspace = Workspace(tmp_path, tool)
    workspace.create("std_msgs/String\n")
    for name in ("compat", "scripts"):
        (workspace.project / name).symlink_to(REPOSITORY / name)
    workspace.write("bubblesim/CMakeLists.txt", PROJECT)
    workspace.add_package("mouse_teleop", {})
    workspace.write("mouse_teleop/CMakeLists.txt", USERS_PACKAGE.format(name="mouse_teleop"))
    workspace.build()
    programs = {package for package in PACKAGES if (workspace.folder / "devel" / "lib" / package).is_dir()}
    assert programs == PACKAGES.keys() - {"mouse_teleop"}


def test_installed_packages_come_first(tmp_path: Path) -> None:
    workspace = Workspace(tmp_path / "workspace", "catkin_make")
    workspace.create("std_msgs/String\n")
    for name in ("compat", "scripts"):
        (workspace.project / name).symlink_to(REPOSITORY / name)
    workspace.write("bubblesim/CMakeLists.txt", PROJECT)
    installed = tmp_path / "prefix" / "share" / "mouse_teleop" / "package.xml"
    installed.parent.mkdir(parents=True)
    installed.write_text("<package><name>mouse_teleop</name></package>")
    result = workspace.run("catkin_make", "-C", workspace.folder, f"-DCMAKE_PREFIX_PATH={tmp_path / 'prefix'}")
    assert f"mouse_teleop: using the installed {installed.parent}" in result.stdout, result.stdout
    assert not (workspace.folder / "devel" / "lib" / "mouse_teleop").exists()
