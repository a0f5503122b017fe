# SPDX-License-Identifier: BSD-3-Clause
"""The thread of a script's sysCall_thread, and when it may work on the simulation.

A script's thread is a thread of the operating system, so that one that waits for a socket keeps nobody else waiting. It
may compute at any time, but it works on the simulation only in its turns, while the simulation's thread waits for it.
"""

from __future__ import annotations

import contextlib
import ctypes
import math
import threading
import time
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Protocol, SupportsIndex

SLICE = 0.002  # s of computing, in a turn in automatic mode
_SAMPLE = 0.001  # s between looks at what the thread does
# A thread that has not run for so long sleeps. One that waits for Python's lock looks for it every 5 ms.
_ASLEEP_AFTER = 0.007
_SECONDS_TO_LEAVE = 0.2  # for a thread that looks whether it should end
_SECONDS_TO_END = 0.8


class AnyThread(Protocol):
    """The thread of a script in any language; see ScriptThread."""

    stepping: int
    exit_requested: bool

    @property
    def ident(self) -> int | None:
        """Of the thread of the operating system that it has for itself."""

    def give_turn(self) -> None:
        """Let the thread work in its turn; raise the error that it ended with."""

    def turn(self) -> contextlib.AbstractContextManager[None]:
        """Called by the thread around what it does to the simulation."""

    def step(self) -> None:
        """Called by the thread: gives its turn back."""

    def sleep(self, seconds: float) -> None:
        """Called by the thread: sleeps, unless it is to end."""

    def end(self, wake: Callable[[], None]) -> bool:
        """Ask the thread to end, and make it after a moment; whether it did."""


by_ident: dict[int, AnyThread] = {}
"""The threads of scripts that run."""

plain_sleep = time.sleep


def install() -> None:
    """From now on time.sleep in a script's thread ends when the thread must."""
    time.sleep = _sleep


def _sleep(seconds: float | SupportsIndex) -> None:
    thread = current()
    if thread is None:
        plain_sleep(seconds)
    else:
        thread.sleep(float(seconds))


def current() -> AnyThread | None:
    """The script's thread that calls; None for the simulation's own thread."""
    return by_ident.get(threading.get_ident())


class ScriptThread:
    """Runs a function in turns. All methods but those that say so are for the simulation's thread."""

    def __init__(self, name: str, body: Callable[[], object]) -> None:
        """Make a thread that begins in its first turn."""
        self.stepping = 0  # how often it asked to keep its turns until it gives them back
        self.exit_requested = False
        self._thread = threading.Thread(target=self._run, args=(body,), name=name)
        self._changed = threading.Condition()  # of what follows
        self._turn = False
        self._calling = False  # works on the simulation
        self._steps_to_end = 0
        self._done = False
        self._clock: int | None = None  # of the thread's computing
        self._error: BaseException | None = None
        self._slept_at: int | None = None  # _runs() when it was last found asleep

    def _run(self, body: Callable[[], object]) -> None:
        by_ident[threading.get_ident()] = self
        self._clock = time.pthread_getcpuclockid(threading.get_ident())
        try:
            self._wait_for_turn()
            body()
        except BaseException as error:
            if not self.exit_requested:
                self._error = error
        finally:
            by_ident.pop(threading.get_ident(), None)
            with self._changed:
                self._done = True
                self._changed.notify_all()

    @property
    def ident(self) -> int | None:
        """See AnyThread; none before its first turn."""
        return self._thread.ident

    def give_turn(self) -> None:
        """Let the thread work until it steps, ends, sleeps or its slice is over; raise the error that it ended with."""
        if self._thread.ident is None:
            self._thread.start()
        elif self._slept_at is not None and self._slept_at == self._runs():
            return  # it has been asleep since
        with self._changed:
            self._slept_at = None
            self._turn = True
            self._changed.notify_all()
            try:
                self._wait_while_it_has_its_turn()
            finally:
                self._turn = False
            while self._calling:
                self._changed.wait()
            error, self._error = self._error, None
        if error is not None:
            raise error

    def _wait_while_it_has_its_turn(self) -> None:
        begin = self._computed()
        runs = None
        seen_at = 0.0
        while self._turn and not self._done:
            notified = self._changed.wait(_SAMPLE)
            if not self.stepping and self._computed() - begin >= SLICE:
                return
            if notified or self._calling:
                continue
            now = time.monotonic()
            before, runs = runs, self._runs()
            if runs is None or runs != before:
                seen_at = now
            elif now - seen_at >= _ASLEEP_AFTER:
                self._slept_at = runs
                return

    def _computed(self) -> float:
        """Seconds for which a processor has worked on the thread: one that waits for a processor loses nothing."""
        if self._clock is None:
            return 0.0
        try:
            return time.clock_gettime(self._clock)
        except OSError:  # it has ended
            return math.inf

    def _runs(self) -> int | None:
        """How often the thread has run, when it sleeps now."""
        try:
            status = Path(f"/proc/self/task/{self._thread.native_id}/status").read_text(encoding="utf-8")
        except OSError:  # it has ended
            return None
        fields = dict(line.partition(":")[::2] for line in status.splitlines())
        if fields["State"].split()[0] not in "SD":
            return None
        return int(fields["voluntary_ctxt_switches"]) + int(fields["nonvoluntary_ctxt_switches"])

    @contextlib.contextmanager
    def turn(self) -> Iterator[None]:
        """Called by the thread around what it does to the simulation: waits for its turn, and keeps it."""
        if self._calling:
            yield
            return
        self._wait_for_turn(calling=True)
        try:
            yield
        finally:
            with self._changed:
                self._calling = False
                if not self._turn:
                    self._changed.notify_all()

    def step(self) -> None:
        """Called by the thread: gives its turn back and waits for the next one."""
        if self._calling:
            raise RuntimeError("a callback that a function of sim or simROS calls cannot wait for the next step")
        with self._changed:
            if self.exit_requested:  # once, so that it sees the request
                self._steps_to_end += 1
                if self._steps_to_end > 1:
                    raise SystemExit
                return
            self._turn = False
            self._changed.notify_all()
        self._wait_for_turn()

    def _wait_for_turn(self, *, calling: bool = False) -> None:
        with self._changed:
            self._changed.wait_for(lambda: self._turn or self.exit_requested)
            if not self._turn:
                raise SystemExit
            self._calling = calling

    def sleep(self, seconds: float) -> None:
        """Called by the thread: sleeps, unless it is to end."""
        with self._changed:
            if self._changed.wait_for(lambda: self.exit_requested, seconds):
                raise SystemExit

    def end(self, wake: Callable[[], None]) -> bool:
        """Ask the thread to end, and make it after a moment; whether it did.

        :param wake: ends what the thread may wait for.
        """
        begin = time.monotonic()
        with self._changed:
            self.exit_requested = self._turn = True
            self._changed.notify_all()
        if self._thread.ident is None or self._thread is threading.current_thread():
            return True
        asleep = self._slept_at is not None and self._slept_at == self._runs()
        self._thread.join(0 if asleep else _SECONDS_TO_LEAVE)
        while self._thread.is_alive() and time.monotonic() - begin < _SECONDS_TO_END:
            ctypes.pythonapi.PyThreadState_SetAsyncExc(ctypes.c_ulong(self._thread.ident), ctypes.py_object(SystemExit))
            wake()
            self._thread.join(0.05)
        self._turn = False
        return not self._thread.is_alive()
