# SPDX-License-Identifier: BSD-3-Clause
"""Steps and loads do not fill the memory, and leave neither files nor threads. tests/sim counts allocations."""

import json
import os
import subprocess
import sys

import pytest

pytestmark = pytest.mark.skipif("LD_PRELOAD" in os.environ, reason="a sanitizer keeps memory that was given back")

COUNT = """
import json, os, sys
from pathlib import Path
import bubblesim

def now():
    status = dict(line.split(':', 1) for line in Path('/proc/self/status').read_text().splitlines())
    files = len(list(Path('/proc/self/fd').iterdir()))
    return int(status['VmRSS'].split()[0]) / 1000, files, int(status['Threads'])

def steps(count):
    simulation = bubblesim.Simulation('tricycle', seed=1)
    simulation.object('/FrontMotor').target_velocity = 3.0
    simulation.step(2000)
    yield now()
    simulation.step(count)
    yield now()

def loads(count):
    for number in range(count + 50):
        if number == 50:
            yield now()
        bubblesim.Simulation('tricycle').step()
    yield now()

print(json.dumps(list(globals()[sys.argv[1]](int(sys.argv[2])))))
"""


def measured(kind: str, count: int) -> list[list[float]]:
    """Return memory, MB, open files and threads before and after so many steps or loads, in a process of its own."""
    run = subprocess.run([sys.executable, "-c", COUNT, kind, str(count)], capture_output=True, text=True, check=True)
    return list(json.loads(run.stdout))


@pytest.mark.parametrize("count", [10_000, pytest.param(1_000_000, marks=pytest.mark.long)])
def test_steps_do_not_fill_the_memory(count: int) -> None:
    before, after = measured("steps", count)
    assert after[0] - before[0] < 0.2, "MB; a megabyte in ten million steps is allowed, and the allocator's pages"
    assert after[1:] == before[1:]


@pytest.mark.parametrize("count", [100, pytest.param(10_000, marks=pytest.mark.long)])
def test_loads_do_not_fill_the_memory(count: int) -> None:
    before, after = measured("loads", count)
    assert after[0] - before[0] < 1.0 + count * 1e-4, "MB"
    assert after[1:] == before[1:]
