# SPDX-License-Identifier: BSD-3-Clause
"""The house style, checked by its tools."""

import subprocess
import sys
from pathlib import Path

import pytest

from ros_support import REPOSITORY

CPP_FOLDERS = ("include", "src", "tests", "benchmarks")
SPELLED = (
    *("CHANGELOG.md", "CONTRIBUTING.md", "README.md", "benchmarks", "docs", "include", "launch", "meta", "msg"),
    *("python", "scenes", "scripts", "src", "web/src"),
)


def check(*command: str) -> None:
    """Fail the test with the tool's output."""
    run = subprocess.run(command, cwd=REPOSITORY, capture_output=True, text=True, check=False)
    if run.returncode != 0:
        pytest.fail(f"{' '.join(command)[:200]}\n{run.stdout}{run.stderr}", pytrace=False)


def test_ruff_finds_nothing() -> None:
    check(sys.executable, "-m", "ruff", "check")


def test_python_is_formatted() -> None:
    check(sys.executable, "-m", "ruff", "format", "--check")


def test_types_hold() -> None:
    check(sys.executable, "-m", "mypy", "--strict", "python", "meta")


def test_words_are_spelled_right() -> None:
    check(sys.executable, "-m", "codespell_lib", *SPELLED)


def test_cpp_is_formatted() -> None:
    files = [path for folder in CPP_FOLDERS for path in (REPOSITORY / folder).rglob("*.?pp")]
    pinned = str(Path(sys.executable).with_name("clang-format"))  # other versions format differently
    check(pinned, "--dry-run", "-Werror", *map(str, files))


def test_shell_scripts_parse() -> None:
    programs = ("setup", "test", "demo", "docs", "package", "wheel", "fuzz", "soak")
    for name in (*programs, "environment/activate.bash", "environment/sanitize.bash"):
        check("bash", "-n", f"scripts/{name}")


def test_the_container_follows_its_linter() -> None:
    check(str(Path(sys.executable).with_name("hadolint")), "config/ci/Containerfile")
