# SPDX-License-Identifier: BSD-3-Clause
"""Measure a simulation in lockstep with a controller: the tricycle and its rospy node.

    python benchmarks/lockstep/lockstep.py [--rounds N] [--seconds S]

Source the workspace first; the program starts its own masters. Prints medians over the rounds: the time from the start
to the first message of the controller, and the real-time factor after that.
"""

from __future__ import annotations

import argparse
import os
import statistics
import tempfile
import time
from pathlib import Path

from bubblesim.running.processes import Programs
from bubblesim.testing.master import start_master
from bubblesim.testing.simulator import Simulator

CONTROLLER = ["rosrun", "bubblesim", "tricycle_avoid.py"]
TOPICS = ["/speed", "/steering"]
FIRST = 0.15  # s of simulation time: three steps; the last one has waited for the controller


def measure(seconds: float) -> tuple[float, float]:
    """Return the seconds until the first message of the controller, and the real-time factor."""
    with tempfile.TemporaryDirectory() as folder, Programs(Path(folder)) as programs:
        begin = time.monotonic()
        master = start_master(programs)
        os.environ.update(master.environment)
        programs.start("controller", *CONTROLLER)
        tricycle = Simulator(master, programs, Path(folder, "run.bag"), "tricycle", TOPICS)
        tricycle.run(FIRST)
        started = time.monotonic()
        tricycle.run(seconds)
        rate = seconds / (time.monotonic() - started)
        tricycle.close()
    return started - begin, rate


def main() -> None:
    """Measure and print the results."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--rounds", type=int, default=5)
    parser.add_argument("--seconds", type=float, default=300.0, help="simulated seconds per round")
    arguments = parser.parse_args()
    starts, rates = zip(*(measure(arguments.seconds) for _ in range(arguments.rounds)), strict=True)
    print(f"start to first message of the controller: {statistics.median(starts):.2f} s (best {min(starts):.2f})")
    print(f"real-time factor: {statistics.median(rates):.0f} (worst {min(rates):.0f})")


if __name__ == "__main__":
    main()
