# SPDX-License-Identifier: BSD-3-Clause
"""The arguments of scripts/fuzz; test_corpus.cpp reads what it has found."""

import subprocess

import pytest

from ros_support import REPOSITORY

CORPUS = REPOSITORY / "tests" / "corpus"


def fuzz(*arguments: str) -> "subprocess.CompletedProcess[str]":
    return subprocess.run([REPOSITORY / "scripts" / "fuzz", *arguments], capture_output=True, text=True, check=False)


def test_help_lists_the_targets_that_have_seeds() -> None:
    run = fuzz("--help")
    assert run.returncode == 0
    listed = next(line for line in run.stdout.splitlines() if line.startswith("  TARGET")).split()[1:]
    assert sorted(listed) == sorted(folder.name for folder in CORPUS.iterdir())


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
