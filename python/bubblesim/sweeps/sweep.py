# SPDX-License-Identifier: BSD-3-Clause
"""Runs a sweep: what its journal has not yet, on workers."""

from __future__ import annotations

import os
from collections.abc import Callable, Iterable, Iterator, Sequence
from pathlib import Path
from typing import Protocol

from bubblesim.sweeps.journal import Journal
from bubblesim.sweeps.local_workers import LocalWorkers
from bubblesim.sweeps.programs import Program
from bubblesim.sweeps.ray_workers import RayWorkers
from bubblesim.sweeps.results import Row, rows_of
from bubblesim.sweeps.tasks import Outcome, SweepError, Task


class Workers(Protocol):
    """What carries out runs."""

    def outcomes(self, tasks: Iterable[Task]) -> Iterator[tuple[Task, Outcome]]:
        """Carry out the runs; yield each as it ends, in any order."""


def make_workers(text: str, program: Program) -> Workers:
    """Make the workers of "local" (a process for each CPU), "4" (so many), "ray" or "ray://ADDRESS"."""
    if text == "local":
        return LocalWorkers(program, len(os.sched_getaffinity(0)))
    if text.isdecimal() and 1 <= int(text) <= 1024:
        return LocalWorkers(program, int(text))
    if text == "ray":
        return RayWorkers(program)
    if text.startswith("ray://") and len(text) > len("ray://"):
        return RayWorkers(program, text.removeprefix("ray://"))
    raise SweepError(f"--workers is 'local', a number from 1 to 1024, 'ray' or 'ray://ADDRESS'; found {text!r}")


def run_sweep(
    program: Program,
    tasks: Sequence[Task],
    workers: Workers,
    journal: Path,
    *,
    fresh: bool = False,
    on_progress: Callable[[int, int, int], None] = lambda done, failed, total: None,
) -> list[Row]:
    """Carry out the runs that the journal does not have; return all rows in the order of the tasks.

    :param on_progress: called with the numbers of runs that have ended, of those that failed, and of all.
    :raises SweepError: the program or the journal cannot be used.
    """
    with Journal(journal, program, fresh=fresh) as written:
        left = [task for task in tasks if task not in written.outcomes]
        done = len(tasks) - len(left)
        failed = sum(1 for task in tasks if task in written.outcomes and written.outcomes[task].error)
        on_progress(done, failed, len(tasks))
        if left:
            for task, outcome in workers.outcomes(left):
                written.add(task, outcome)
                done += 1
                failed += bool(outcome.error)
                on_progress(done, failed, len(tasks))
        return rows_of(tasks, written.outcomes)
