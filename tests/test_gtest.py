# SPDX-License-Identifier: BSD-3-Clause
"""Runs each case of the C++ tests, the built programs with names that start with test_, as a separate item."""

import os
import subprocess
from pathlib import Path

import pytest

from ros_support import REPOSITORY


def test_programs() -> list[Path]:
    """Return all built C++ tests, in the folder BUBBLESIM_BUILD_DIR or else in the workspace."""
    folder = Path(os.environ.get("BUBBLESIM_BUILD_DIR", REPOSITORY / ".ws" / "devel" / "lib" / "bubblesim"))
    return sorted(path for path in folder.rglob("test_*") if path.is_file() and is_program(path))


test_programs.__test__ = False  # type: ignore[attr-defined]


def is_program(path: Path) -> bool:
    """Return whether a file is a compiled program."""
    with path.open("rb") as file:
        return os.access(path, os.X_OK) and file.read(4) == b"\x7fELF"


def cases(program: Path) -> list[str]:
    """Return the full names of a program's cases, Suite.Case, from --gtest_list_tests: cases are indented."""
    listing = subprocess.run([program, "--gtest_list_tests"], capture_output=True, text=True, check=True).stdout
    names, suite = [], ""
    for line in listing.splitlines():
        name = line.partition("#")[0].rstrip()
        if name.startswith("  "):
            names.append(suite + name.strip())
        elif name.endswith("."):
            suite = name
    return names


ITEMS = [
    pytest.param(program, case, id=f"{program.name}-{case}") for program in test_programs() for case in cases(program)
]


def test_cpp_tests_are_built() -> None:
    assert ITEMS, "no C++ test found: build with -DBUBBLESIM_BUILD_TESTS=ON"


@pytest.mark.parametrize(("program", "case"), ITEMS)
def test_cpp(program: Path, case: str) -> None:
    run = subprocess.run([program, f"--gtest_filter={case}"], capture_output=True, text=True, check=False, timeout=300)
    if run.returncode != 0:
        pytest.fail(f"exit code {run.returncode}\n{run.stdout}{run.stderr}", pytrace=False)
