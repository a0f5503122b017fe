# SPDX-License-Identifier: BSD-3-Clause
"""The layers: which part may know which. Debian keeps ROS headers in /usr/include, so no compiler flag holds this."""

import re
import subprocess
from pathlib import Path

import pytest

from ros_support import REPOSITORY, built

INCLUDE = re.compile(r'^\s*#\s*include\s*[<"]([^>"]+)[>"]', re.MULTILINE)
ROS = re.compile(
    r"^(ros|roscpp|rosgraph_msgs|std_msgs|std_srvs|geometry_msgs|sensor_msgs|nav_msgs|tf2\w*|xmlrpcpp|XmlRpc\w*)(/|\.h)"
)
PYTHON = re.compile(r"^(pybind11/|Python\.h|numpy/)")

# What each folder must not include.
FORBIDDEN = {
    "include/bubblesim": [ROS, PYTHON],
    "src/sim": [ROS, PYTHON, re.compile(r"^bubblesim/(messages/|ros_bridge|child_scripts)")],
    "src/messages": [ROS, PYTHON, re.compile(r"^bubblesim/(?!messages/|nearest_names)")],
    "src/peer_guard": [PYTHON, re.compile(r"^bubblesim/")],
    "src/nodes": [PYTHON, re.compile(r"^bubblesim/")],
    "src/ros_bridge": [PYTHON, re.compile(r"^bubblesim/child_scripts")],
    "src/bindings": [ROS, re.compile(r"^bubblesim/(ros_bridge|child_scripts)")],
    "src/scripting": [ROS, re.compile(r"^bubblesim/ros_bridge")],
}


@pytest.mark.parametrize("folder", FORBIDDEN)
def test_includes_stay_within_the_layers(folder: str) -> None:
    sources = sorted((REPOSITORY / folder).rglob("*.?pp"))
    assert sources, f"{folder} has no sources"
    strays = [
        f"{source.relative_to(REPOSITORY)}: {name}"
        for source in sources
        for name in INCLUDE.findall(source.read_text())
        if any(pattern.match(name) for pattern in FORBIDDEN[folder])
    ]
    assert not strays


@pytest.mark.parametrize("folder", ["controllers", "navigation"])
def test_logic_knows_no_ros(folder: str) -> None:
    sources = sorted((REPOSITORY / "python" / "bubblesim" / folder).glob("*.py"))
    assert sources
    ros = re.compile(r"^\s*(?:from|import) (rospy|tf2_ros|\w+_msgs|bubblesim\.nodes)\b", re.MULTILINE)
    assert [source.name for source in sources if ros.search(source.read_text())] == []


@pytest.mark.parametrize(
    ("library", "foreign"),
    [
        ("libbubblesim.so", r"ros|python|xmlrpc|tf2"),
        ("libbubblesim_messages.so", r"libros|python|xmlrpc|tf2"),
        ("libbubblesim_ros.so", r"python"),
    ],
)
def test_libraries_need_only_what_their_layer_may_know(library: str, foreign: str) -> None:
    dynamic = subprocess.run(["readelf", "-d", built(library)], capture_output=True, text=True, check=True).stdout
    needed = re.findall(r"\(NEEDED\).*\[(.+)\]", dynamic)
    assert needed
    assert [name for name in needed if re.search(foreign, name)] == []


@pytest.mark.long
def test_core_builds_alone(tmp_path: Path) -> None:
    options = ["-DBUBBLESIM_WITH_ROS=OFF", "-DBUBBLESIM_WITH_PYTHON=OFF"]
    subprocess.run(["cmake", "-S", REPOSITORY, "-B", tmp_path, *options], check=True)
    subprocess.run(["cmake", "--build", tmp_path, "--parallel", "2"], check=True)
    assert list(tmp_path.rglob("libbubblesim.so"))
