# SPDX-License-Identifier: BSD-3-Clause
"""Programs that the demo starts, and ends together with everything that they started themselves."""

from __future__ import annotations

import contextlib
import os
import signal
import subprocess
from pathlib import Path
from types import TracebackType

_PATIENCE = {signal.SIGINT: 10.0, signal.SIGTERM: 5.0, signal.SIGKILL: 5.0}  # s that each has to take effect


class DemoError(Exception):
    """The demo cannot go on; the text says why, for its user."""


class Program:
    """A running program in a process group of its own, its output in a file."""

    def __init__(self, name: str, command: list[str], log_folder: Path) -> None:
        """Starts it; `name` is what messages call it."""
        self.name = name
        self.log = log_folder / f"{name.replace(' ', '_')}.log"
        with self.log.open("w") as output:
            self._process = subprocess.Popen(
                command, stdin=subprocess.DEVNULL, stdout=output, stderr=subprocess.STDOUT, start_new_session=True
            )

    def check(self) -> None:
        """Raises DemoError, with its last words, when it has ended."""
        code = self._process.poll()
        if code is not None:
            last_words = "\n".join(f"  {line}" for line in self.log.read_text(errors="replace").splitlines()[-15:])
            raise DemoError(f"the {self.name} ended with exit code {code}; it said:\n{last_words}")

    def stop(self) -> None:
        """Ends the whole group, politely first."""
        for number, patience in _PATIENCE.items():
            try:
                os.killpg(self._process.pid, number)
                self._process.wait(patience)
                break
            except (ProcessLookupError, subprocess.TimeoutExpired):
                continue
        with contextlib.suppress(ProcessLookupError):
            os.killpg(self._process.pid, signal.SIGKILL)  # what it left behind


class Programs:
    """All programs of the demo; as a context manager it ends them with the block, the last one first."""

    def __init__(self, log_folder: Path) -> None:
        """Nothing runs yet."""
        self._log_folder = log_folder
        self._running: list[Program] = []

    def start(self, name: str, *command: str) -> Program:
        """Starts a program, which `check` watches from now on."""
        program = Program(name, list(command), self._log_folder)
        self._running.append(program)
        return program

    def check(self) -> None:
        """Raises DemoError when one has ended."""
        for program in self._running:
            program.check()

    def __enter__(self) -> Programs:
        """Starts a block at whose end all is ended."""
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, traceback: TracebackType | None
    ) -> None:
        """Ends all programs."""
        while self._running:
            self._running.pop().stop()
