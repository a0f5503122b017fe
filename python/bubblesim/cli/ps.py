# SPDX-License-Identifier: BSD-3-Clause
"""bubblesim ps: list one's own simulators on this machine, and end them."""

from __future__ import annotations

import argparse
import os
import signal
import sys
import time
from typing import Any

_END = 10.0  # s; the node takes at most 2 s

_DESCRIPTION = """\
Lists the simulators that you run on this machine: their process, scene, memory, time since the start, ROS master,
ROS 2 domain, and the port of their window. Those of other users are not shown.

  bubblesim ps                 list them
  bubblesim ps --stop 4711     end one, by its process
  bubblesim ps --stop all      end all of them"""


def add_parser(commands: Any) -> None:
    """Add the command's arguments."""
    parser: argparse.ArgumentParser = commands.add_parser(
        "ps",
        help="list and end your simulators on this machine",
        description=_DESCRIPTION,
        formatter_class=argparse.RawDescriptionHelpFormatter,
        allow_abbrev=False,
    )
    parser.add_argument("--stop", metavar="PROCESS", help="end this simulator as Ctrl-C does, or all of them: all")
    parser.set_defaults(command=_ps, parser=parser)


def _ps(options: argparse.Namespace) -> int:
    from bubblesim.running.own_runs import own_runs

    runs = own_runs()
    if options.stop is not None:
        chosen = [run.process for run in runs if options.stop in ("all", str(run.process))]
        if not chosen and options.stop != "all":
            known = ", ".join(str(run.process) for run in runs) or "none"
            raise ValueError(f"--stop: {options.stop} is not a process of a simulator of yours; they are: {known}")
        return _stop(chosen)
    if not runs:
        print("no simulator of yours runs on this machine", file=sys.stderr)
        return 0
    rows = [("PROCESS", "SCENE", "MEMORY", "TIME", "ROS MASTER", "DOMAIN", "WINDOW")]
    for run in runs:
        minutes, seconds = divmod(int(run.seconds), 60)
        window = str(run.window) if run.window else "-"
        times = f"{minutes}:{seconds:02}"
        memory = f"{run.memory:.0f} MB"
        rows.append((str(run.process), run.scene or "-", memory, times, run.master or "-", run.domain or "-", window))
    widths = [max(map(len, column)) for column in zip(*rows, strict=True)]
    for row in rows:
        print("  ".join(cell.ljust(width) for cell, width in zip(row, widths, strict=True)).rstrip())
    return 0


def _stop(processes: list[int]) -> int:
    """End processes of this user; return 1 if one is left."""
    for process in processes:
        try:
            os.kill(process, signal.SIGINT)
        except ProcessLookupError:
            continue
    deadline = time.monotonic() + _END
    left = processes
    while left and time.monotonic() < deadline:
        left = [process for process in left if _runs(process)]
        time.sleep(0.05)
    for process in processes:
        print(f"{process} {'does not end' if process in left else 'ended'}")
    return int(bool(left))


def _runs(process: int) -> bool:
    try:
        os.kill(process, 0)
    except ProcessLookupError:
        return False
    return True
