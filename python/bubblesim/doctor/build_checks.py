# SPDX-License-Identifier: BSD-3-Clause
"""Check Python and the built node by running them."""

from __future__ import annotations

import shutil
import site
import subprocess
import sys
import tempfile
from collections.abc import Iterator
from pathlib import Path

import numpy as np
import rospkg

from bubblesim.doctor.finding import Finding, ok, problem, warning
from bubblesim.running.places import node_program
from bubblesim.running.processes import RunError

_SOURCE = "source the setup.bash of the workspace that bubblesim was built in"
_TIMEOUT = 30.0  # s
_IN_LUA = "function sysCall_init() end"


def check_python() -> Iterator[Finding]:
    """Check that Python and numpy are those that ROS and bubblesim are built for."""
    version = ".".join(map(str, sys.version_info[:3]))
    if sys.base_prefix != "/usr":
        yield problem(f"Python {version} ({sys.executable}) is not Debian's", "PATH=/usr/bin:$PATH bubblesim doctor")
    else:
        yield ok(f"Python {version}, {sys.executable}")
    yield from _check_terminals_python()
    yield core_fault() or ok(f"numpy {np.__version__}")
    yield from _check_users_packages()


def _check_terminals_python() -> Iterator[Finding]:
    """Name another Python that comes first on PATH, as pyenv's or conda's: it lacks Debian's modules of ROS."""
    first = shutil.which("python3")
    if first is None:
        return
    found = subprocess.run(
        [first, "-c", "import sys; print(sys.base_prefix)"], capture_output=True, text=True, check=False
    )
    if found.stdout.strip() not in ("", "/usr"):
        yield warning(
            f"the terminal's python3 is {first}, not Debian's: your scripts do not find rospy and bubblesim with it",
            "export PATH=/usr/bin:$PATH, or start scripts with /usr/bin/python3",
        )


def _check_users_packages() -> Iterator[Finding]:
    """Name the user's own packages that hide Debian's from other programs; ours leave them out."""
    folder = Path(site.getusersitepackages())
    hiding = [name for name in ("numpy", "matplotlib") if (folder / name).is_dir()]
    if hiding:
        yield warning(
            f"{' and '.join(hiding)} in {folder} may not fit Debian's Python modules: rospy programs load them, "
            "bubblesim's own programs use Debian's",
            f"export PYTHONNOUSERSITE=1, or pip uninstall {' '.join(hiding)}",
        )


def core_fault() -> Finding | None:
    """Return the problem if the compiled module cannot be loaded, as with a numpy that it was not built for."""
    try:
        import bubblesim._core  # noqa: F401
    except ImportError as error:
        fault, _, cure = str(error).partition(": pip install ")
        if cure:
            where = Path(np.__file__).parent
            return problem(f"{fault} in {where}", f"{sys.executable} -m pip install {cure}")
        return problem(f"the compiled part of bubblesim cannot be loaded: {fault}", _SOURCE)
    return None


def check_package() -> Iterator[Finding]:
    """Check that rosrun and roslaunch find the package."""
    try:
        yield ok(f"rosrun finds bubblesim in {rospkg.RosPack().get_path('bubblesim')}")
    except rospkg.ResourceNotFound:
        yield problem("rosrun and roslaunch do not find bubblesim: it is not in ROS_PACKAGE_PATH", _SOURCE)


def check_node() -> Iterator[Finding]:
    """Check that the node runs, and a script in each language."""
    try:
        node = str(node_program())
    except RunError as error:
        yield problem(str(error), "scripts/setup in a clone, or `catkin build` in your workspace")
        return
    failure = _run([node, "ball", "--no-ros", "--speed", "max", "--until", "0.1", "--strict"])
    if failure:
        yield problem(
            f"{node} does not run: {failure}", "scripts/setup in a clone, or `catkin build` in your workspace"
        )
        return
    yield ok(f"the node runs: {node}")
    with tempfile.TemporaryDirectory() as folder:
        script = Path(folder) / "script.lua"
        script.write_text(_IN_LUA)
        options = ["--no-ros", "--speed", "max", "--until", "0.1", "--strict", "--child-script", f"/Ball={script}"]
        failure = _run([node, "ball", *options])
    if failure:
        yield warning(
            f"scripts in Lua do not run: {failure}", "pip install lupa==2.8 in the active virtual environment"
        )
    else:
        yield ok("scripts run, in Python and in Lua")


def _run(command: list[str]) -> str:
    """Return the error, or an empty string."""
    try:
        run = subprocess.run(command, capture_output=True, text=True, timeout=_TIMEOUT, check=False)
    except (OSError, subprocess.TimeoutExpired) as error:
        return str(error)
    output = " ".join(run.stderr.split())
    return "" if run.returncode == 0 else f"exit code {run.returncode}: {output}"
