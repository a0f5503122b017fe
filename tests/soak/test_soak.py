# SPDX-License-Identifier: BSD-3-Clause
"""What a soak finds in its samples, and a soak of one round."""

import os
import subprocess
import sys

import pytest

from ros_support import REPOSITORY

sys.path.insert(0, str(REPOSITORY / "tests" / "soak"))

from soak import Sample, growth, judge


def samples(*, memory: float = 0.0, files: float = 0.0, threads: float = 0.0) -> list[Sample]:
    """Return those of ten hours, with what is added in each."""
    return [
        Sample(hour, 90.0 + memory * hour, 30 + round(files * hour), 15 + round(threads * hour)) for hour in range(11)
    ]


def test_the_growth_is_the_slope_of_the_second_half() -> None:
    steady = samples(memory=2.5)
    assert growth(steady) == pytest.approx(2.5)
    assert growth([Sample(0.0, 1.0, 30, 15), *steady[1:]]) == pytest.approx(2.5), "what the first round loads stays"


def test_a_node_that_keeps_its_size_is_fine() -> None:
    assert judge(samples()) == []
    assert judge(samples(memory=0.5)) == []


@pytest.mark.parametrize(
    ("grown", "found"),
    [
        ({"memory": 20.0}, "memory grows by 20.0 MB an hour"),
        ({"files": 1.0}, "9 more open files"),
        ({"threads": 1.0}, "9 more threads"),
    ],
)
def test_what_grows_is_named(grown: dict[str, float], found: str) -> None:
    assert judge(samples(**grown)) == [found]


@pytest.mark.long
def test_one_round_ends_well() -> None:
    env = {**os.environ, "PYTHONPATH": f"{REPOSITORY / 'tests' / 'support'}:{os.environ.get('PYTHONPATH', '')}"}
    command = [sys.executable, str(REPOSITORY / "tests" / "soak" / "soak.py"), "--hours", "0"]
    run = subprocess.run(command, env=env, capture_output=True, text=True, timeout=300, check=False)
    assert run.returncode == 0, run.stderr
    assert "rounds: 1 in" in run.stdout
