# SPDX-License-Identifier: BSD-3-Clause
"""Programs that a run needs, and ends together with everything that they started themselves."""

from __future__ import annotations

import contextlib
import os
import signal
import subprocess
from pathlib import Path
from types import TracebackType

_POLITE = signal.SIGINT
# s that each has to take effect; a roscore itself waits 15 s for its master, which outlives it when it is cut short.
_PATIENCE = {_POLITE: 20.0, signal.SIGTERM: 5.0, signal.SIGKILL: 5.0}


class RunError(Exception):
    """A run cannot go on; the text says why, for its user."""


class Program:
    """A running program in a process group of its own, its output in a file or where ours goes."""

    def __init__(self, name: str, command: list[str], log: Path | None, *, serves_others: bool = False) -> None:
        """Starts it; `name` is what messages call it. RunError when it is not there."""
        self.name = name
        self.serves_others = serves_others
        self._log = log
        self._asked = self._stopped = False
        with contextlib.ExitStack() as files:
            output = files.enter_context(log.open("w")) if log else None
            try:
                self._process = subprocess.Popen(
                    command,
                    stdin=subprocess.DEVNULL,
                    stdout=output,
                    stderr=subprocess.STDOUT if output else None,
                    start_new_session=True,
                )
            except OSError as error:
                raise RunError(f"the {name} cannot be started: {command[0]}: {error.strerror}") from error

    @property
    def exit_code(self) -> int | None:
        """None while it runs; negative: the signal that ended it."""
        return self._process.poll()

    def check(self) -> None:
        """Raises RunError, with its last words if they were kept, when it has ended by itself."""
        if self._stopped or self.exit_code is None:
            return
        said = ""
        if self._log:
            last_words = self._log.read_text(errors="replace").splitlines()[-15:]
            said = "; it said:" + "".join(f"\n  {line}" for line in last_words)
        raise RunError(f"the {self.name} ended with exit code {self.exit_code}{said}")

    def ask_to_end(self) -> None:
        """What `stop` begins with, without waiting."""
        self._asked = self._stopped = True
        with contextlib.suppress(ProcessLookupError):
            os.killpg(self._process.pid, _POLITE)

    def stop(self) -> None:
        """Ends the whole group, politely first."""
        if not self._asked:
            self.ask_to_end()
        for number, patience in _PATIENCE.items():
            try:
                if number != _POLITE:
                    os.killpg(self._process.pid, number)
                self._process.wait(patience)
                break
            except (ProcessLookupError, subprocess.TimeoutExpired):
                continue
        with contextlib.suppress(ProcessLookupError):
            os.killpg(self._process.pid, signal.SIGKILL)  # what it left behind


class Programs:
    """All of them; as a context manager it ends them with the block: at once, then those that the others need."""

    def __init__(self, log_folder: Path) -> None:
        """Nothing runs yet."""
        self._log_folder = log_folder
        self.running: list[Program] = []

    def start(self, name: str, *command: str, shown: bool = False, serves_others: bool = False) -> Program:
        """Starts a program, which `check` watches from now on.

        :param shown: its output goes where ours goes.
        :param serves_others: it ends after the others, as a ROS master should.
        """
        log = None if shown else self._log_folder / f"{name.replace(' ', '_')}.log"
        program = Program(name, list(command), log, serves_others=serves_others)
        self.running.append(program)
        return program

    def check(self) -> None:
        """Raises RunError when one has ended."""
        for program in self.running:
            program.check()

    def __enter__(self) -> Programs:
        """Starts a block at whose end all is ended."""
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, traceback: TracebackType | None
    ) -> None:
        """Ends all programs."""
        for serving in (False, True):
            ending = [program for program in self.running if program.serves_others == serving]
            for program in ending:
                program.ask_to_end()
            for program in ending:
                program.stop()
        self.running.clear()
