# SPDX-License-Identifier: BSD-3-Clause
"""Child processes of a run, ended together with all processes that they started."""

from __future__ import annotations

import contextlib
import signal
import subprocess
from collections.abc import Mapping
from pathlib import Path
from types import TracebackType

from bubblesim.program.groups import signal_group

_FIRST_SIGNAL = signal.SIGINT
# s to wait after each signal; roscore itself waits 15 s for its master, which would survive if roscore is killed.
_TIMEOUTS = {_FIRST_SIGNAL: 20.0, signal.SIGTERM: 5.0, signal.SIGKILL: 5.0}


class RunError(Exception):
    """A run cannot continue; the text states why."""


class Program:
    """A running program in its own process group; its output goes to a file or to ours."""

    def __init__(
        self,
        name: str,
        command: list[str],
        log: Path | None,
        *,
        serves_others: bool = False,
        environment: Mapping[str, str] | None = None,
    ) -> None:
        """Start it, in our environment or another one; `name` is used in messages.

        :raises RunError: if it cannot be started.
        """
        self.name = name
        self.serves_others = serves_others
        self._log = log
        self._end_requested = self._stopped = False
        with contextlib.ExitStack() as files:
            output = files.enter_context(log.open("w")) if log else None
            try:
                self._process = subprocess.Popen(
                    command,
                    stdin=subprocess.DEVNULL,
                    stdout=output,
                    stderr=subprocess.STDOUT if output else None,
                    env=environment,
                    start_new_session=True,
                )
            except OSError as error:
                raise RunError(f"cannot start the {name}: {command[0]}: {error.strerror}") from error

    @property
    def exit_code(self) -> int | None:
        """Return the exit code, None while it runs; negative: the signal that ended it."""
        return self._process.poll()

    def output(self) -> str:
        """Return its output so far, if stored."""
        return self._log.read_text(errors="replace") if self._log else ""

    def check(self) -> None:
        """Raise RunError, with its last output if stored, if it has ended by itself."""
        if self._stopped or self.exit_code is None:
            return
        output = ""
        if self._log:
            last_lines = self.output().splitlines()[-15:]
            output = "; its last output:" + "".join(f"\n  {line}" for line in last_lines)
        raise RunError(f"the {self.name} ended with exit code {self.exit_code}{output}")

    def request_end(self) -> None:
        """Send the first signal of `stop`, without waiting."""
        self._end_requested = self._stopped = True
        with contextlib.suppress(ProcessLookupError):
            signal_group(self._process, _FIRST_SIGNAL)

    def stop(self) -> None:
        """End the whole process group: SIGINT, then SIGTERM, then SIGKILL."""
        if not self._end_requested:
            self.request_end()
        for number, timeout in _TIMEOUTS.items():
            try:
                if number != _FIRST_SIGNAL:
                    signal_group(self._process, number)
                self._process.wait(timeout)
                break
            except (ProcessLookupError, subprocess.TimeoutExpired):
                continue
        with contextlib.suppress(ProcessLookupError):
            signal_group(self._process, signal.SIGKILL)  # remaining processes of the group


class Programs:
    """All programs; as a context manager it ends them together, and those with ``serves_others`` afterwards."""

    def __init__(self, log_folder: Path) -> None:
        """Create it without programs."""
        self._log_folder = log_folder
        self.running: list[Program] = []

    def start(
        self,
        name: str,
        *command: str,
        shown: bool = False,
        serves_others: bool = False,
        environment: Mapping[str, str] | None = None,
    ) -> Program:
        """Start a program; from now on `check` watches it.

        :param shown: write its output to ours.
        :param serves_others: end it after the others, for a ROS master.
        :param environment: of the program, if not ours.
        """
        log = None if shown else self._log_folder / f"{name.replace(' ', '_')}.log"
        program = Program(name, list(command), log, serves_others=serves_others, environment=environment)
        self.running.append(program)
        return program

    def check(self) -> None:
        """Raise RunError if a program has ended."""
        for program in self.running:
            program.check()

    def __enter__(self) -> Programs:
        """Start a block after which all programs are ended."""
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, traceback: TracebackType | None
    ) -> None:
        """End all programs."""
        for serving in (False, True):
            ending = [program for program in self.running if program.serves_others == serving]
            for program in ending:
                program.request_end()
            for program in ending:
                program.stop()
        self.running.clear()
