# SPDX-License-Identifier: BSD-3-Clause
"""The arguments of scripts/fuzz, and with --long its programs; test_corpus.cpp reads what they have found."""

import subprocess

import pytest

from ros_support import REPOSITORY

CORPUS = REPOSITORY / "tests" / "corpus"
TARGETS = sorted(folder.name for folder in CORPUS.iterdir())
GROUPS = REPOSITORY / ".ws" / "groups"


def fuzz(*arguments: str) -> "subprocess.CompletedProcess[str]":
    return subprocess.run([REPOSITORY / "scripts" / "fuzz", *arguments], capture_output=True, text=True, check=False)


def test_help_lists_the_targets_that_have_seeds() -> None:
    run = fuzz("--help")
    assert run.returncode == 0
    listed = next(line for line in run.stdout.splitlines() if line.startswith("  TARGET")).split()[1:]
    assert sorted(listed) == TARGETS


@pytest.mark.parametrize(
    ("arguments", "error"),
    [
        (["nothing"], "[fuzz] no target 'nothing'; there are: cbor material mesh message"),
        ([], "[fuzz] no target ''; there are: "),
        (["cbor", "--seconds", "soon"], "[fuzz] --seconds needs a number above 0, found 'soon'"),
        (["cbor", "--fast"], "[fuzz] unknown option '--fast', see scripts/fuzz --help"),
    ],
)
def test_misuse_is_reported_before_anything_is_built(arguments: list[str], error: str) -> None:
    run = fuzz(*arguments)
    assert run.returncode == 2
    assert run.stderr.startswith(error)
    assert run.stdout == ""


@pytest.mark.long
@pytest.mark.skipif(
    not GROUPS.is_file() or not {"fuzz", "ros2"} <= set(GROUPS.read_text().split()),
    reason="needs scripts/setup --with fuzz --with ros2",
)
@pytest.mark.parametrize("target", TARGETS)
def test_a_reader_that_clang_compiled_fails_by_errors_only(target: str) -> None:
    """clang once read groups of numbers as if they were aligned: each step of a robot ended in a segmentation fault."""
    run = fuzz(target, "--runs", "2000")
    assert run.returncode == 0, run.stderr[-2000:]
