# SPDX-License-Identifier: BSD-3-Clause
"""Runs of a sweep on a Ray cluster. The run of a node or process that dies is repeated elsewhere.

The nodes need bubblesim, and what the program imports or reads, at the same places as the driver.
"""

from __future__ import annotations

import functools
import logging
import os
from collections import Counter, deque
from collections.abc import Callable, Iterable, Iterator, Mapping
from typing import Any

from bubblesim.sweeps.programs import Program, Run, execute
from bubblesim.sweeps.tasks import Outcome, SweepError, Task

ATTEMPTS = 3  # of a run whose process or node dies
_QUEUED = 4  # runs for each CPU that are submitted before one ends


class RayWorkers:
    """The CPUs of a cluster: that of an address ("auto": the one on this machine), or a new one on this machine."""

    def __init__(self, program: Program, address: str | None = None) -> None:
        """Connect to the cluster; a connection that exists is used."""
        os.environ.setdefault("RAY_USAGE_STATS_ENABLED", "0")
        os.environ.setdefault("RAY_ACCEL_ENV_VAR_OVERRIDE_ON_ZERO", "0")  # Ray warns without it
        try:
            import ray
        except ImportError as error:
            raise SweepError("--workers ray needs Ray; to install it: pip install 'ray==2.60.*'") from error
        self._ray = ray
        self._program = program
        if not ray.is_initialized():
            try:
                ray.init(address=address, log_to_driver=False, logging_level=logging.ERROR, include_dashboard=False)
            except Exception as error:
                raise SweepError(f"cannot connect to Ray at {address or 'this machine'}: {error}") from error

    def outcomes(self, tasks: Iterable[Task]) -> Iterator[tuple[Task, Outcome]]:
        """Carry out the runs; yield each as it ends, in any order. Raise SweepError if the program cannot be loaded."""
        ray = self._ray
        run = ray.remote(num_cpus=1, max_retries=0)(_run)  # repeated here, with a limit for each run
        program = ray.put(self._program)
        waiting = deque(tasks)
        attempts: Counter[Task] = Counter()
        running: dict[Any, Task] = {}
        while waiting or running:
            limit = _QUEUED * max(int(ray.cluster_resources().get("CPU", 1)), 1)
            while waiting and len(running) < limit:
                task = waiting.popleft()
                running[run.remote(program, task)] = task
            ended, _ = ray.wait(list(running), num_returns=1, timeout=10.0)
            for reference in ended:
                task = running.pop(reference)
                try:
                    answer = ray.get(reference)
                except ray.exceptions.RayError as error:
                    attempts[task] += 1
                    if attempts[task] < ATTEMPTS:
                        waiting.appendleft(task)
                        continue
                    answer = Outcome(error=f"the process of the run died {ATTEMPTS} times: {error}")
                if isinstance(answer, str):
                    raise SweepError(answer)
                yield task, answer


def _run(program: Program, task: Task) -> Outcome | str:
    """Carry out one run on a node; return a string if the program cannot be loaded."""
    try:
        function = _loaded(program)  # type: ignore[arg-type]  # programs are frozen dataclasses
    except (ValueError, LookupError) as error:
        return str(error)
    return execute(function, program, task)


@functools.lru_cache(maxsize=4)
def _loaded(program: Program) -> Callable[[Run], Mapping[str, Any]]:
    return program.load()
