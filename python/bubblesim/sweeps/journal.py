# SPDX-License-Identifier: BSD-3-Clause
"""The journal of a sweep: a line of JSON for each finished run, so that an interrupted sweep can go on.

The first line names the program and has its hash. A line that a crash has cut is dropped.
"""

from __future__ import annotations

import fcntl
import json
import os
import time
from collections.abc import Mapping
from pathlib import Path
from types import TracebackType
from typing import Any

from bubblesim.sweeps.programs import Program
from bubblesim.sweeps.tasks import Outcome, SweepError, Task

_FORMAT = "bubblesim sweep 1"
_SYNC = 1.0  # s, time after which written lines are on the disk


class Journal:
    """Outcomes on disk. One process at a time has it open."""

    def __init__(self, file: Path, program: Program, *, fresh: bool = False) -> None:
        """Open the journal of a program, or create it; ``fresh``: drop what it holds.

        :raises SweepError: it is that of another program, in use, or damaged.
        """
        self.file = file
        self.outcomes: dict[Task, Outcome] = {}
        self._synced = time.monotonic()
        try:
            self._descriptor = os.open(file, os.O_RDWR | os.O_CREAT | os.O_APPEND | os.O_CLOEXEC, 0o666)
        except OSError as error:
            raise SweepError(f"cannot write {file}: {error.strerror}") from error
        try:
            self._lock()
            if fresh:
                os.ftruncate(self._descriptor, 0)
            self._read({"format": _FORMAT, "program": program.name, "digest": program.digest}, program.depends_on)
        except BaseException:
            os.close(self._descriptor)
            raise

    def add(self, task: Task, outcome: Outcome) -> None:
        """Write the outcome of a run."""
        self.outcomes[task] = outcome
        line: dict[str, Any] = {"seed": task.seed, "parameters": dict(task.parameters)}
        line |= {"error": outcome.error} if outcome.error else {"results": dict(outcome.results)}
        self._write(line)
        if time.monotonic() - self._synced > _SYNC:
            self._sync()

    def __enter__(self) -> Journal:
        """Start the block."""
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, traceback: TracebackType | None
    ) -> None:
        """Close the file."""
        self._sync()
        os.close(self._descriptor)

    def _lock(self) -> None:
        try:
            fcntl.flock(self._descriptor, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except BlockingIOError as error:
            raise SweepError(f"{self.file} is in use by another sweep; choose another --output") from error

    def _read(self, header: Mapping[str, str], depends_on: str) -> None:
        text = self._content()
        whole = text.rfind(b"\n") + 1
        if whole < len(text):
            os.ftruncate(self._descriptor, whole)
        lines = text[:whole].splitlines()
        if not lines:
            self._write(header)
            return
        found = self._parsed(lines[0], 1)
        if found != header:
            if found.get("format") != _FORMAT:
                what = "is no journal"
            elif found.get("program") != header["program"]:
                what = f"has runs of {found.get('program')}, not of {header['program']}"
            else:
                what = f"has runs from before a change of {depends_on}"
            raise SweepError(f"{self.file} {what}; choose another --output, or repeat all runs with --fresh")
        for number, line in enumerate(lines[1:], 2):
            entry = self._parsed(line, number)
            try:
                task = Task(entry["seed"], tuple(entry["parameters"].items()))
                self.outcomes[task] = Outcome(entry.get("results", {}), entry.get("error", ""))
            except (KeyError, AttributeError) as error:
                raise self._damaged(number) from error

    def _content(self) -> bytes:
        with open(self._descriptor, "rb", closefd=False) as stream:
            return stream.read()

    def _parsed(self, line: bytes, number: int) -> dict[str, Any]:
        try:
            entry = json.loads(line)
        except ValueError as error:
            raise self._damaged(number) from error
        if not isinstance(entry, dict):
            raise self._damaged(number)
        return entry

    def _damaged(self, number: int) -> SweepError:
        return SweepError(f"{self.file}:{number} cannot be read; repair or delete the line, or start with --fresh")

    def _write(self, entry: Mapping[str, Any]) -> None:
        rest = json.dumps(entry, ensure_ascii=False).encode() + b"\n"
        try:
            while rest:
                rest = rest[os.write(self._descriptor, rest) :]
        except OSError as error:
            raise SweepError(f"cannot write {self.file}: {error.strerror}") from error

    def _sync(self) -> None:
        os.fsync(self._descriptor)
        self._synced = time.monotonic()
