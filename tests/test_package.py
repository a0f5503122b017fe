# SPDX-License-Identifier: BSD-3-Clause
"""The Debian package is built of what scripts/setup installs."""

import re
import shutil
import subprocess
from pathlib import Path

import pytest

from ros_support import REPOSITORY

CONTROL = (REPOSITORY / "debian" / "control").read_text()
LISTS = REPOSITORY / "scripts" / "environment"
TOOLS = {"debhelper-compat", "dh-python", "catkin", "python3-venv", "python3-numpy"}  # of packaging
PROGRAMS_OF_WORKSPACES = {"catkin-tools", "python3-venv", "python3-numpy"}


def field(name: str) -> set[str]:
    """Return the packages of a field of the first paragraph that has it."""
    found = re.search(rf"^{name}:\n?((?: .*\n)+)", CONTROL, re.MULTILINE)
    assert found is not None, name
    return {re.sub(r" \(.*\)", "", line.strip(" ,")) for line in found[1].splitlines()}


def listed(name: str) -> set[str]:
    """Return the packages of a list."""
    return {line for line in (LISTS / name).read_text().splitlines() if not line.startswith("#")}


def test_it_is_built_with_what_a_workspace_is_built_with() -> None:
    ros2 = " | ".join(listed(f"packages-ros2-debian-{number}.txt").pop() for number in (12, 13))
    maps = {name for name in listed("packages-maps.txt") if name.endswith("-dev")}
    building = listed("packages-building.txt") - PROGRAMS_OF_WORKSPACES
    assert field("Build-Depends") - TOOLS == building | maps | {ros2}


def test_its_program_explains_itself() -> None:
    run = subprocess.run([REPOSITORY / "scripts" / "package", "--help"], capture_output=True, text=True, check=True)
    assert run.stdout.startswith("usage: scripts/package [FOLDER]")


@pytest.mark.parametrize("arguments", [["--bogus"], ["a", "b"]])
def test_bad_usage_is_explained(arguments: list[str]) -> None:
    run = subprocess.run([REPOSITORY / "scripts" / "package", *arguments], capture_output=True, text=True, check=False)
    assert (run.returncode, run.stderr[:6]) == (2, "usage:")


@pytest.mark.long
@pytest.mark.skipif(shutil.which("dh_python3") is None, reason="needs debhelper and dh-python")
def test_equal_commits_give_equal_packages(tmp_path: Path) -> None:
    """In other folders, at other times, and with another umask."""
    packages = []
    for folder, mask in ((tmp_path / "a", 0o022), (tmp_path / "another" / "folder", 0o027)):
        subprocess.run([REPOSITORY / "scripts" / "package", folder], umask=mask, stdout=subprocess.DEVNULL, check=True)
        (package,) = folder.glob("*.deb")
        packages.append(package)
    assert packages[0].name == packages[1].name
    assert packages[0].read_bytes() == packages[1].read_bytes()
