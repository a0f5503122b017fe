#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Measure what the simulators of a class cost one machine: memory and processor time of each process of a run.

Starts `bubblesim run SCENE --isolated` several times, and reads the kernel's figures of the processes.
"""

import argparse
import contextlib
import os
import signal
import subprocess
import tempfile
import time
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

STARTING_TIMEOUT = 300.0  # s; on a busy machine
ENDING_TIMEOUT = 60.0  # s
SETTLING_TIME = 5.0  # s
TICKS = os.sysconf("SC_CLK_TCK")  # per second
READY = "rosout"
"""The last process of a run that starts."""
PARTS = ("sim", "bubblesim", "roscore", "rosmaster", "rosout")


@dataclass(frozen=True)
class Cost:
    """Of one process."""

    resident: float  # MB in RAM, with all that it shares with others
    proportional: float  # MB, with its part of what it shares
    processor: float  # s since its start


def part_of(process: int) -> str:
    """Return which part of a run a process is."""
    arguments = Path(f"/proc/{process}/cmdline").read_text(errors="replace").split("\0")
    names = [Path(argument).name for argument in arguments[:2]]  # a script has its interpreter first
    return next((name for name in names if name in PARTS), "others")


def cost(process: int) -> Cost:
    """Return what a process costs now."""
    lines = Path(f"/proc/{process}/smaps_rollup").read_text().splitlines()[1:]
    kilobytes = {line.split(":")[0]: int(line.split()[1]) for line in lines}
    fields = Path(f"/proc/{process}/stat").read_text().rpartition(")")[2].split()
    return Cost(kilobytes["Rss"] / 1000, kilobytes["Pss"] / 1000, (int(fields[11]) + int(fields[12])) / TICKS)


def family(process: int) -> Iterator[int]:
    """Yield a process and all processes that it started."""
    yield process
    for thread in Path(f"/proc/{process}/task").iterdir():
        for child in (thread / "children").read_text().split():
            yield from family(int(child))


@contextlib.contextmanager
def started(command: list[str], log: Path) -> Iterator[int]:
    """Start a run, and end it with the block."""
    with log.open("w") as output:
        process = subprocess.Popen(command, stdout=output, stderr=subprocess.STDOUT, start_new_session=True)
    try:
        yield process.pid
    finally:
        process.send_signal(signal.SIGINT)
        process.wait(ENDING_TIMEOUT)


def wait_until_ready(runs: list[int]) -> None:
    """Wait until all parts of all runs are there."""
    deadline = time.monotonic() + STARTING_TIMEOUT
    for run in runs:
        while not {"sim", READY} <= {part_of(process) for process in family(run)}:
            if time.monotonic() > deadline:
                raise SystemExit(f"error: a run has not started in {STARTING_TIMEOUT:g} s")
            time.sleep(0.2)
    time.sleep(SETTLING_TIME)


def main() -> None:
    """Measure, and print the mean of each part of a run and the sum."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--runs", type=int, default=10)
    parser.add_argument("--scene", default="tricycle")
    parser.add_argument("--seconds", type=float, default=20.0, help="over which processor time is taken")
    parser.add_argument("options", nargs="*", metavar="OPTION", help="of the node, after --, such as --paused")
    given = parser.parse_args()
    command = ["bubblesim", "run", given.scene, "--isolated", *given.options]
    with contextlib.ExitStack() as stack:
        logs = Path(stack.enter_context(tempfile.TemporaryDirectory(prefix="classroom-")))
        runs = [stack.enter_context(started(command, logs / str(number))) for number in range(given.runs)]
        wait_until_ready(runs)
        begin = time.monotonic()
        before = {process: cost(process) for run in runs for process in family(run)}
        time.sleep(given.seconds)
        after = {process: cost(process) for process in before}
        seconds = time.monotonic() - begin
        sums: dict[str, list[float]] = {}
        for process, now in after.items():
            share = (now.processor - before[process].processor) / seconds
            figures = (now.resident, now.proportional, 100 * share)
            for name in (part_of(process), "sum"):
                sums[name] = [total + figure for total, figure in zip(sums.get(name, [0.0] * 3), figures, strict=True)]
    print(f"{given.runs} x {' '.join(command)}")
    print(f"{'mean of each':16} {'resident':>9} {'proportional':>13} {'of a core':>10}")
    for name in (*PARTS, "others", "sum"):
        resident, proportional, share = (total / given.runs for total in sums.get(name, [0.0] * 3))
        print(f"{name:16} {resident:6.0f} MB {proportional:10.0f} MB {share:8.1f} %")


if __name__ == "__main__":
    main()
