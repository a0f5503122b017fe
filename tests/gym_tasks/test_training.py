# SPDX-License-Identifier: BSD-3-Clause
"""The programs of the page about learning."""

import re
import subprocess
import sys
from pathlib import Path

import pytest

from ros_support import REPOSITORY

pytest.importorskip("gymnasium")

PROGRAMS = REPOSITORY / "docs" / "learning"


def run(program: str, *arguments: object, timeout: float = 300.0) -> str:
    command = [sys.executable, str(PROGRAMS / program), *map(str, arguments)]
    ended = subprocess.run(command, capture_output=True, text=True, timeout=timeout, check=False)
    assert ended.returncode == 0, ended.stderr
    return ended.stdout


def test_an_iteration_of_the_search_gives_a_policy_and_pictures(tmp_path: Path) -> None:
    output = run("train_pioneer.py", "--iterations", 1, "--episodes", 4, "--output", tmp_path)
    assert "held-out seeds: success" in output
    assert sorted(file.name for file in tmp_path.iterdir()) == ["curve.png", "paths.png", "policy.npy"]


@pytest.mark.long
def test_the_search_learns_to_reach_goals(tmp_path: Path) -> None:
    output = run("train_pioneer.py", "--output", tmp_path, timeout=3000.0)
    found = re.search(r"held-out seeds: success ([0-9.]+)", output)
    assert found
    assert float(found[1]) >= 0.9


def test_ppo_makes_a_few_updates(tmp_path: Path) -> None:
    pytest.importorskip("stable_baselines3")
    output = run("ppo_pioneer.py", "--steps", 2048, "--worlds", 2, "--output", tmp_path)
    assert "reward of 20 episodes" in output
    assert (tmp_path / "ppo_pioneer.zip").is_file()
