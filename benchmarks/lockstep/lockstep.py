# SPDX-License-Identifier: BSD-3-Clause
"""Measures a simulation in step with a controller: the tricycle and its node in rospy.

    python benchmarks/lockstep/lockstep.py [--rounds N] [--seconds S]

With the workspace sourced; it starts masters of its own. Printed are medians over the rounds: how long it takes from
nothing to the first answer of the controller, and how many simulated seconds pass in one after that.
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
FIRST = 0.15  # s of simulation: three steps, of which the last has waited for the controller


def measure(seconds: float) -> tuple[float, float]:
    """Seconds to the first answer, and simulated seconds in one of the machine's."""
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
    """Measure and print."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--rounds", type=int, default=5)
    parser.add_argument("--seconds", type=float, default=300.0, help="of simulation in a round")
    arguments = parser.parse_args()
    starts, rates = zip(*(measure(arguments.seconds) for _ in range(arguments.rounds)), strict=True)
    print(f"from nothing to the first answer: {statistics.median(starts):.2f} s (best {min(starts):.2f})")
    print(f"simulated seconds in one: {statistics.median(rates):.0f} (worst {min(rates):.0f})")


if __name__ == "__main__":
    main()
