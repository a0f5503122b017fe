# SPDX-License-Identifier: BSD-3-Clause
"""A catkin workspace with only bubblesim's message types: real tools, quick to build."""

import os
import shutil
import subprocess
import sys
from dataclasses import dataclass
from pathlib import Path

from ros_support import REPOSITORY

_MANIFEST = """<package format="2">
  <name>{name}</name><version>0.1.0</version><description>of a test</description><license>BSD</license>
  <maintainer email="test@example.org">test</maintainer><buildtool_depend>catkin</buildtool_depend>
</package>
"""
_PROJECT = """cmake_minimum_required(VERSION 3.18)
project(bubblesim LANGUAGES CXX)
find_package(catkin REQUIRED)
add_subdirectory(msg)
catkin_package()
find_package(Python3 REQUIRED COMPONENTS Interpreter)
set(CMAKE_CXX_STANDARD 17)
set(CMAKE_POSITION_INDEPENDENT_CODE ON)
set(BUBBLESIM_LIBRARY_DIR lib)
add_library(bubblesim_options INTERFACE)
add_subdirectory(meta)
add_subdirectory(src/codec)
"""
# Without the packages that take most of a build's time: those of Gazebo's messages and others.
_OWN_PACKAGES = """include(own_packages.cmake)
add_own_packages(used test_msgs)
set(BUBBLESIM_MESSAGE_PACKAGES "${used}" PARENT_SCOPE)
"""
_USERS_PACKAGE = """cmake_minimum_required(VERSION 3.18)
project({name})
find_package(catkin REQUIRED COMPONENTS message_generation)
add_message_files(FILES {files})
generate_messages()
catkin_package()
"""


@dataclass
class Workspace:
    """Made and built by `tool`: "catkin_make" or "catkin"."""

    folder: Path
    tool: str

    @property
    def project(self) -> Path:
        """Return the root of bubblesim's sources in the workspace."""
        return self.folder / "src" / "bubblesim"

    @property
    def env(self) -> dict[str, str]:
        """Return the environment of a shell that has not sourced any other workspace."""
        others = ("CMAKE_PREFIX_PATH", "ROS_PACKAGE_PATH")
        env = {name: value for name, value in os.environ.items() if name not in others}
        return {**env, "PATH": f"/usr/bin:{env['PATH']}"}

    def create(self, messages: str) -> None:
        """Make the workspace with a list of messages."""
        self.project.mkdir(parents=True)
        shutil.copytree(REPOSITORY / "meta", self.project / "meta")
        (self.project / "msg").mkdir()
        parts = [f"msg/{name}" for name in ("own_packages.cmake", "find_workspace_package.py", "test_msgs")]
        for name in ("include", "python", "src", *parts):
            (self.project / name).symlink_to(REPOSITORY / name)
        self.write("bubblesim/msg/CMakeLists.txt", _OWN_PACKAGES)
        self.write("bubblesim/meta/messages.txt", messages)
        self.write("bubblesim/meta/services.txt", "")
        self.write("bubblesim/package.xml", _MANIFEST.format(name="bubblesim"))
        self.write("bubblesim/CMakeLists.txt", _PROJECT)
        if self.tool == "catkin":
            self.run("catkin", "init")

    def add_package(self, name: str, messages: dict[str, str]) -> None:
        """Write a user package that builds its messages as usual."""
        self.write(f"{name}/package.xml", _MANIFEST.format(name=name))
        self.write(f"{name}/CMakeLists.txt", _USERS_PACKAGE.format(name=name, files=" ".join(messages)))
        for file, text in messages.items():
            self.write(f"{name}/msg/{file}", text)

    def write(self, path: str, text: str) -> None:
        """Write a file in the source space."""
        file = self.folder / "src" / path
        file.parent.mkdir(parents=True, exist_ok=True)
        file.write_text(text)

    def run(self, *command: str | Path) -> subprocess.CompletedProcess[str]:
        """Run a program at the workspace's root."""
        return subprocess.run(
            command,
            cwd=self.folder,
            env=self.env,
            stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT,
            text=True,
            check=False,
        )

    def build(self) -> None:
        """Build all packages."""
        tool = (
            ["catkin_make", "-C", str(self.folder)]
            if self.tool == "catkin_make"
            else ["catkin", "build", "--no-status", "--no-notify"]
        )
        result = self.run(*tool)
        assert result.returncode == 0, result.stdout

    def add_message(self, *arguments: str) -> subprocess.CompletedProcess[str]:
        """Run the program add_message on this workspace's lists."""
        program = REPOSITORY / "scripts" / "add_message"
        return self.run(sys.executable, program, "--project", self.project, *arguments)

    def compiled(self, text: str) -> bool:
        """Return whether a string is in the built library."""
        library = self.folder / "devel" / "lib" / "libbubblesim_messages.so"
        return text.encode() in library.read_bytes()
