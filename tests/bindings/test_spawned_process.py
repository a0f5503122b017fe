# SPDX-License-Identifier: BSD-3-Clause
"""Processes that multiprocessing spawns import the core too."""

import subprocess
import sys
from pathlib import Path

PROGRAM = """
import multiprocessing
import bubblesim

def time_step(name):
    return bubblesim.Simulation(name).time_step

if __name__ == "__main__":
    bubblesim.Scene("tricycle")
    with multiprocessing.get_context("spawn").Pool(1) as pool:
        print(pool.apply_async(time_step, ("tricycle",)).get(timeout=60))
"""


def test_a_spawned_process_runs_a_simulation(tmp_path: Path) -> None:
    program = tmp_path / "program.py"
    program.write_text(PROGRAM)
    run = subprocess.run([sys.executable, program], capture_output=True, text=True, check=False, timeout=90)
    assert run.stdout == "0.05\n", run.stderr
