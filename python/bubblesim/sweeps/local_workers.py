# SPDX-License-Identifier: BSD-3-Clause
"""Runs of a sweep in processes of this machine. The run of a process that dies is repeated by a new one."""

from __future__ import annotations

import contextlib
import os
import signal
import socket
import subprocess
import sys
from collections import Counter, deque
from collections.abc import Iterable, Iterator
from multiprocessing.connection import Connection, wait

from bubblesim.sweeps.programs import Program
from bubblesim.sweeps.tasks import Outcome, SweepError, Task

ATTEMPTS = 3  # of a run whose process dies
_ONE_THREAD = dict.fromkeys(("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS"), "1")


class LocalWorkers:
    """Some processes; they are new ones instead of forks, so that they start equal."""

    def __init__(self, program: Program, count: int) -> None:
        """Set the number of processes; they start with the first run."""
        self._program = program
        self._count = count

    def outcomes(self, tasks: Iterable[Task]) -> Iterator[tuple[Task, Outcome]]:
        """Carry out the runs; yield each as it ends, in any order. Raise SweepError if the program cannot be loaded."""
        waiting = deque(tasks)
        attempts: Counter[Task] = Counter()
        workers = [_Worker(self._program) for _ in range(min(self._count, len(waiting)))]
        try:
            while workers:
                ready = wait([worker.connection for worker in workers])
                for worker in [worker for worker in workers if worker.connection in ready]:
                    workers.remove(worker)
                    task = worker.task
                    try:
                        outcome = worker.receive()
                    except (EOFError, OSError):
                        outcome = self._after_death(worker, attempts, waiting)
                        if waiting:
                            workers.append(_Worker(self._program))
                    else:
                        if waiting:
                            worker.send(waiting.popleft())
                            workers.append(worker)
                        else:
                            worker.end()
                    if task is not None and outcome is not None:
                        yield task, outcome
        finally:
            for worker in workers:
                worker.end()

    def _after_death(self, worker: _Worker, attempts: Counter[Task], waiting: deque[Task]) -> Outcome | None:
        """Put the run of a dead process back, or return its failure."""
        task, reason = worker.task, worker.end()
        if task is None:
            raise SweepError(f"a worker process cannot start: it {reason}")
        attempts[task] += 1
        if attempts[task] < ATTEMPTS:
            waiting.appendleft(task)
            return None
        return Outcome(error=f"the process of the run {reason}, {ATTEMPTS} times")


class _Worker:
    """One process and its task."""

    def __init__(self, program: Program) -> None:
        self.task: Task | None = None
        ours, theirs = socket.socketpair()
        with theirs:
            command = [sys.executable, "-m", "bubblesim.sweeps.worker", str(theirs.fileno())]
            self._process = subprocess.Popen(
                command,
                pass_fds=[theirs.fileno()],
                stdin=subprocess.DEVNULL,
                env={**os.environ, **_ONE_THREAD},
                start_new_session=True,  # Ctrl-C ends the driver, and that the workers
            )
        self.connection: Connection = Connection(ours.detach())
        self._send(program)

    def receive(self) -> Outcome | None:
        """Return the outcome of the task; None of a new worker, which is ready. Raise EOFError if it has died."""
        answer = self.connection.recv()
        if isinstance(answer, str):
            self.end()
            raise SweepError(answer)
        self.task = None
        return answer  # type: ignore[no-any-return]

    def send(self, task: Task) -> None:
        """Start a run."""
        self.task = task
        self._send(task)

    def end(self) -> str:
        """End the process; return how it ended."""
        self.connection.close()
        try:
            code = self._process.wait(timeout=0.0 if self.task is None else 1.0)
        except subprocess.TimeoutExpired:
            self._process.kill()
            code = self._process.wait()
        return f"was ended by {signal.Signals(-code).name}" if code < 0 else f"ended with exit code {code}"

    def _send(self, message: object) -> None:
        with contextlib.suppress(OSError):  # it has died: receive() notices
            self.connection.send(message)
