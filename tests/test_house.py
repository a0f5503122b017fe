# SPDX-License-Identifier: BSD-3-Clause
"""The layers: allowed dependencies. Debian keeps ROS headers in /usr/include, so no compiler flag can check this."""

import ast
import re
import subprocess
from collections.abc import Iterable, Iterator
from pathlib import Path

import pytest

from ros2_peer import has_ros2
from ros_support import REPOSITORY, built

INCLUDE = re.compile(r'^\s*#\s*include\s*[<"]([^>"]+)[>"]', re.MULTILINE)
ROS = re.compile(
    r"^(ros|roscpp|rosgraph_msgs|std_msgs|std_srvs|geometry_msgs|sensor_msgs|nav_msgs|tf2\w*|xmlrpcpp|XmlRpc\w*)(/|\.h)"
)
PYTHON = re.compile(r"^(pybind11/|Python\.h|numpy/)")
FAST_DDS = re.compile(r"^fast(dds|rtps|cdr)/")

# Includes that are forbidden in each folder.
FORBIDDEN = {
    "include/bubblesim": [ROS, PYTHON],
    "src/sim": [ROS, PYTHON, re.compile(r"^bubblesim/(messages/|ros_bridge|child_scripts)")],
    "src/codec": [ROS, PYTHON, re.compile(r"^bubblesim/(?!messages/|nearest_names)")],
    "src/reading_messages": [ROS, PYTHON, re.compile(r"^bubblesim/(messages/(?!fields)|ros_bridge|child_scripts)")],
    "src/peer_guard": [PYTHON, re.compile(r"^bubblesim/")],
    "src/nodes": [PYTHON, re.compile(r"^bubblesim/")],
    "src/ros1": [PYTHON, FAST_DDS, re.compile(r"^bubblesim/(child_scripts|ros2_bridge)")],
    "src/ros2": [ROS, PYTHON, re.compile(r"^bubblesim/(child_scripts|ros_bridge)")],
    "src/endpoints": [ROS, PYTHON, FAST_DDS],
    "src/python_codec": [ROS, re.compile(r"^bubblesim/(?!messages/|nearest_names)")],
    "src/bindings": [ROS, FAST_DDS, re.compile(r"^bubblesim/(ros2?_bridge|child_scripts)")],
    "src/scripting": [ROS, FAST_DDS, re.compile(r"^bubblesim/ros2?_bridge")],
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


def test_one_file_knows_which_version_fast_dds_has() -> None:
    sources = [path for folder in ("src", "tests", "benchmarks") for path in (REPOSITORY / folder).rglob("*.?pp")]
    versions = re.compile(r"include <fast(dds|rtps|cdr)/|FASTDDS_VERSION|eprosima")
    assert [path.name for path in sources if versions.search(path.read_text())] == ["fast_dds.hpp"]


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
        ("libbubblesim_ros.so", r"python|fastrtps|fastdds"),
        pytest.param("libbubblesim_ros2.so", r"libros|python|xmlrpc|tf2", marks=has_ros2),
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


def places() -> dict[str, bool]:
    """Return the folders in the order of docs/architecture.md, and whether they are marked as no simulation."""
    rows = re.findall(r"^\| `([\w/.]+)`(\*?) \|", (REPOSITORY / "docs/architecture.md").read_text(), re.MULTILINE)
    return {folder: bool(star) for folder, star in rows}


def folder_of(file: Path, listed: Iterable[str]) -> str:
    """Return the innermost folder of the list that has a file."""
    path = file.relative_to(REPOSITORY)
    found = next((str(each) for each in (path, *path.parents) if str(each) in listed), None)
    assert found, f"{path} is in no folder that docs/architecture.md lists"
    return found


def sources() -> list[Path]:
    """Return the sources of the libraries and of the Python package."""
    return [
        file
        for folder, pattern in (("include", "*.?pp"), ("src", "*.?pp"), ("python/bubblesim", "*.py"))
        for file in sorted((REPOSITORY / folder).rglob(pattern))
        if file != REPOSITORY / "python/bubblesim/__init__.py"  # imports the public names at their first use
    ]


def included(source: Path) -> set[Path]:
    """Return our files that a C++ file includes."""
    library = REPOSITORY.joinpath(*source.relative_to(REPOSITORY).parts[:2])
    places = [source.parent, library, REPOSITORY / "include", *sorted((REPOSITORY / "src").iterdir())]
    candidates = [[place / name for place in places] for name in INCLUDE.findall(source.read_text())]
    return {found for files in candidates if (found := next((file for file in files if file.is_file()), None))}


def dependencies() -> Iterator[tuple[Path, Path]]:
    """Yield each file with each of ours that it includes or imports."""
    known = modules()
    core = REPOSITORY / "src/bindings/CMakeLists.txt"
    for source in sources():
        if source.suffix == ".py":
            names = imported_names(source)
            needed = {known[name] for name in names & known.keys()} | ({core} if "_core" in names else set())
        else:
            needed = included(source)
        yield from ((source, file) for file in needed)


def modules() -> dict[str, Path]:
    """Return all modules of the package by their names without `bubblesim.`."""
    package = REPOSITORY / "python" / "bubblesim"
    files = [file for file in package.rglob("*.py") if file != package / "__init__.py"]
    return {".".join(file.relative_to(package).with_suffix("").parts).removesuffix(".__init__"): file for file in files}


def imported_names(file: Path) -> set[str]:
    """Return what a file imports of our package, without `bubblesim.`, also what only its annotations need."""
    names: set[str] = set()
    for node in ast.walk(ast.parse(file.read_text())):
        if isinstance(node, ast.Import):
            names.update(alias.name for alias in node.names)
        elif isinstance(node, ast.ImportFrom) and node.module:
            names.update(f"{node.module}.{alias.name}" for alias in node.names)
            names.add(node.module)
    return {name.removeprefix("bubblesim.") for name in names if name.startswith("bubblesim.")}


def test_each_folder_has_its_place_in_the_order() -> None:
    listed = places()
    folders = {"/".join(source.relative_to(REPOSITORY).parent.parts[:3]) for source in sources()}
    assert folders - listed.keys() == set(), "docs/architecture.md does not list them"
    assert [name for name in listed if not (REPOSITORY / name).exists()] == []


def test_folders_need_only_what_is_below_them() -> None:
    order = list(places())
    found = [(folder_of(source, order), folder_of(file, order), source) for source, file in dependencies()]
    assert len(found) > 1000
    strays = {
        f"{source.relative_to(REPOSITORY)} needs {below}"
        for above, below, source in found
        if order.index(above) > order.index(below)
    }
    assert sorted(strays) == []


def test_the_simulation_does_without_what_is_no_simulation() -> None:
    is_apart = places()
    assert any(is_apart.values())
    may = {"python/bubblesim", "python/bubblesim/cli"}
    strays = {
        f"{source.relative_to(REPOSITORY)} needs {folder_of(file, is_apart)}"
        for source, file in dependencies()
        if is_apart[folder_of(file, is_apart)]
        and not is_apart[above := folder_of(source, is_apart)]
        and above not in may
    }
    assert sorted(strays) == []


def test_no_python_modules_import_each_other_in_a_circle() -> None:
    known = modules()
    waiting = {module: imported_names(file) & known.keys() - {module} for module, file in known.items()}
    while ready := [module for module, needed in waiting.items() if not needed & waiting.keys()]:
        for module in ready:
            del waiting[module]
    assert not waiting
