# SPDX-License-Identifier: BSD-3-Clause
"""Each case of the C++ tests, the built programs with names that start with test_, is a separate item."""

import contextlib
import json
import os
import subprocess
import tempfile
from pathlib import Path
from typing import Any

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


@pytest.fixture(scope="module")
def outcomes(request: pytest.FixtureRequest) -> dict[tuple[Path, str], dict[str, Any]]:
    """Return the outcome of each selected case, of one run of each program: starting one takes longer than most cases.

    Cases of a program that does not finish are missing.
    """
    selected: dict[Path, list[str]] = {}
    for item in request.session.items:
        if isinstance(item, pytest.Function) and item.originalname == "test_cpp" and item.fspath == request.fspath:
            selected.setdefault(item.callspec.params["program"], []).append(item.callspec.params["case"])
    found = {}
    for program, names in selected.items():
        for test in run(program, names).get("testsuites", []):
            found |= {(program, f"{test['name']}.{case['name']}"): case for case in test["testsuite"]}
    return found


def run(program: Path, names: list[str]) -> dict[str, Any]:
    """Run cases in one process and return the program's report; empty if it does not finish."""
    with tempfile.TemporaryDirectory() as folder:
        report = Path(folder, "report.json")
        command = [program, f"--gtest_filter={':'.join(names)}", f"--gtest_output=json:{report}"]
        with contextlib.suppress(subprocess.TimeoutExpired):
            subprocess.run(command, capture_output=True, check=False, timeout=600)
        return json.loads(report.read_text()) if report.exists() else {}


@pytest.mark.parametrize(("program", "case"), ITEMS)
def test_cpp(program: Path, case: str, outcomes: dict[tuple[Path, str], dict[str, Any]]) -> None:
    outcome = outcomes.get((program, case))
    if outcome is None:
        alone = subprocess.run(
            [program, f"--gtest_filter={case}"], capture_output=True, text=True, check=False, timeout=300
        )
        if alone.returncode != 0:
            pytest.fail(f"exit code {alone.returncode}\n{alone.stdout}{alone.stderr}", pytrace=False)
        return
    if outcome["result"] == "SKIPPED":
        pytest.skip(f"{program} --gtest_filter={case} prints why")
    if failures := outcome.get("failures"):
        pytest.fail("\n".join(each["failure"] for each in failures), pytrace=False)
