# SPDX-License-Identifier: BSD-3-Clause
"""The layers: allowed dependencies. Debian keeps ROS headers in /usr/include, so no compiler flag can check this."""

import ast
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

# Includes that are forbidden in each folder.
FORBIDDEN = {
    "include/bubblesim": [ROS, PYTHON],
    "src/sim": [ROS, PYTHON, re.compile(r"^bubblesim/(messages/|ros_bridge|child_scripts)")],
    "src/codec": [ROS, PYTHON, re.compile(r"^bubblesim/(?!messages/|nearest_names)")],
    "src/reading_messages": [ROS, PYTHON, re.compile(r"^bubblesim/(messages/(?!fields)|ros_bridge|child_scripts)")],
    "src/peer_guard": [PYTHON, re.compile(r"^bubblesim/")],
    "src/nodes": [PYTHON, re.compile(r"^bubblesim/")],
    "src/ros1": [PYTHON, re.compile(r"^bubblesim/child_scripts")],
    "src/python_codec": [ROS, re.compile(r"^bubblesim/(?!messages/|nearest_names)")],
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


def test_one_file_knows_which_version_embree_has() -> None:
    sources = [path for folder in ("src", "tests", "benchmarks") for path in (REPOSITORY / folder).rglob("*.?pp")]
    versions = re.compile(r"include <embree\d|RTC_VERSION|RTCIntersectContext|RTCRayQueryContext")
    assert [path.name for path in sources if versions.search(path.read_text())] == ["embree.hpp"]


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


# The imports that each Python package may use of the others; nothing imports `cli`, `demo` and `testing`.
PYTHON_LAYERS = [
    {"program", "output", "addresses", "geometry", "messages", "delayed_rows", "scene_elements"},
    {"controllers"},
    {"ros_messages", "navigation", "nodes"},
    {"running"},
    {
        "scripting.dummies",
        "scripting.drawings",
        "scripting.graphs",
        "scripting.log",
        "scripting.object_collections",
        "scripting.primitive_shapes",
        "scripting.set_colours",
        "scripting.set_numbers",
        "scripting.problems",
        "scripting.scene_edits",
        "scripting.saved_scene",
        "scripting.stored_values",
    },
    {"scripting.caller", "scripting.allowed_programs", "scripting.threads"},
    {"scripting.api"},
    {"scripting.language"},
    {"scripting.host"},
    {"gazebo_plugins", "observers", "remote"},
    {"checking", "services"},
    {"web"},
    {"doctor"},
    {"sweeps", "gym_tasks"},
    {"cli", "demo", "testing"},
]


def modules() -> dict[str, Path]:
    """Return all modules of the package by their names without `bubblesim.`."""
    package = REPOSITORY / "python" / "bubblesim"
    files = [file for file in package.rglob("*.py") if file != package / "__init__.py"]
    return {".".join(file.relative_to(package).with_suffix("").parts).removesuffix(".__init__"): file for file in files}


def imports(file: Path, known: dict[str, Path]) -> set[str]:
    """Return our modules that a file imports, including those that only its annotations need."""
    names: set[str] = set()
    for node in ast.walk(ast.parse(file.read_text())):
        if isinstance(node, ast.Import):
            names.update(alias.name for alias in node.names)
        elif isinstance(node, ast.ImportFrom) and node.module:
            names.update(f"{node.module}.{alias.name}" for alias in node.names)
            names.add(node.module)
    ours = {name.removeprefix("bubblesim.") for name in names if name.startswith("bubblesim.")}
    return {name for name in ours if name in known and known[name].name != "__init__.py"}


def layer(module: str) -> int:
    found = [
        number
        for number, names in enumerate(PYTHON_LAYERS)
        if any(module == name or module.startswith(f"{name}.") for name in names)
    ]
    assert len(found) == 1 or module == "scripting", f"{module} belongs to no layer"
    return found[0] if found else -1


def test_python_packages_import_one_way() -> None:
    known = modules()
    strays = [
        f"{module} imports {name}"
        for module, file in sorted(known.items())
        for name in sorted(imports(file, known))
        if layer(name) > layer(module)
    ]
    assert not strays


def test_no_python_modules_import_each_other_in_a_circle() -> None:
    known = modules()
    waiting = {module: imports(file, known) - {module} for module, file in known.items()}
    while ready := [module for module, needed in waiting.items() if not needed & waiting.keys()]:
        for module in ready:
            del waiting[module]
    assert not waiting
