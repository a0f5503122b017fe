# SPDX-License-Identifier: BSD-3-Clause
"""The thread of a script's sysCall_thread, and its turns.

A script's thread is a thread of the operating system, so waiting for a socket does not block other scripts. It can
compute at any time, but accesses the simulation only in its turns, while the simulation's thread waits for it.
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

SLICE = 0.002  # s of computing time per turn in automatic mode, unless the script changes it
_SAMPLE = 0.001  # s between checks of the thread
# s after which a thread that has not run counts as asleep; while waiting for the GIL, a thread runs every 5 ms.
_ASLEEP_AFTER = 0.007
_SECONDS_TO_EXIT = 0.2  # s for a thread that checks the exit request
_TRIES_TO_END = 12  # counted, because a machine that runs none of our threads for a while delays both sides
_SECONDS_PER_TRY = 0.05


class AnyThread(Protocol):
    """The thread of a script in any language; see ScriptThread."""

    stepping: int
    slice: float
    exit_requested: bool

    @property
    def ident(self) -> int | None:
        """Return the id of its operating system thread; None if it has none."""

    def run_turn(self) -> None:
        """Run the thread for one turn; raise the error that ended it."""

    def turn(self) -> contextlib.AbstractContextManager[None]:
        """Return a context in which the thread accesses the simulation; called by the thread."""

    def step(self) -> None:
        """End the turn; called by the thread."""

    def sleep(self, seconds: float) -> None:
        """Sleep, unless the thread has to end; called by the thread."""

    def end(self, wake: Callable[[], None]) -> bool:
        """Request the thread to end, then force it; return whether it ended."""


by_ident: dict[int, AnyThread] = {}
"""The running threads of scripts."""

plain_sleep = time.sleep


def install() -> None:
    """From now on, end time.sleep in a script's thread when the thread has to end."""
    time.sleep = _sleep


def _sleep(seconds: float | SupportsIndex) -> None:
    thread = current()
    if thread is None:
        plain_sleep(seconds)
    else:
        thread.sleep(float(seconds))


def current() -> AnyThread | None:
    """Return the calling script's thread; None for the simulation's thread."""
    return by_ident.get(threading.get_ident())


class ScriptThread:
    """Runs a function in turns. Methods are for the simulation's thread unless stated otherwise."""

    def __init__(self, name: str, body: Callable[[], object]) -> None:
        """Create a thread that starts in its first turn."""
        self.stepping = 0  # depth of nested setStepping calls
        self.slice = SLICE
        self.exit_requested = False
        self._thread = threading.Thread(target=self._run, args=(body,), name=name)
        self._changed = threading.Condition()  # guards the following members
        self._turn = False
        self._calling = False  # accesses the simulation
        self._steps_to_end = 0
        self._done = False
        self._clock: int | None = None  # CPU clock of the thread
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
        """Return the id of its operating system thread; None before its first turn."""
        return self._thread.ident

    def run_turn(self) -> None:
        """Run the thread until it steps, ends, sleeps or its time slice is over; raise the error that ended it."""
        if self._thread.ident is None:
            self._thread.start()
        elif self._slept_at is not None and self._slept_at == self._runs():
            return  # still asleep
        with self._changed:
            self._slept_at = None
            self._turn = True
            self._changed.notify_all()
            try:
                self._wait_for_turn_end()
            finally:
                self._turn = False
            while self._calling:
                self._changed.wait()
            error, self._error = self._error, None
        if error is not None:
            raise error

    def _wait_for_turn_end(self) -> None:
        begin = self._computed()
        runs = None
        seen_at = 0.0
        while self._turn and not self._done:
            notified = self._changed.wait(_SAMPLE)
            if not self.stepping and self._computed() - begin >= self.slice:
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
        """Return the CPU time of the thread, s; waiting for a processor does not count."""
        if self._clock is None:
            return 0.0
        try:
            return time.clock_gettime(self._clock)
        except OSError:  # it has ended
            return math.inf

    def _runs(self) -> int | None:
        """Return the number of context switches if the thread is asleep, else None."""
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
        """Wait for a turn and keep it during the block, which accesses the simulation; called by the thread."""
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
        """End the turn and wait for the next one; called by the thread."""
        if self._calling:
            raise RuntimeError("a callback called by a function of sim or simROS cannot wait for the next step")
        with self._changed:
            if self.exit_requested:  # once, so that the thread can check the request
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
        """Sleep, unless the thread has to end; called by the thread."""
        with self._changed:
            if self._changed.wait_for(lambda: self.exit_requested, seconds):
                raise SystemExit

    def end(self, wake: Callable[[], None]) -> bool:
        """Request the thread to end, then force it; return whether it ended.

        :param wake: wakes the thread if it waits.
        """
        with self._changed:
            self.exit_requested = self._turn = True
            self._changed.notify_all()
        if self._thread.ident is None or self._thread is threading.current_thread():
            return True
        asleep = self._slept_at is not None and self._slept_at == self._runs()
        self._thread.join(0 if asleep else _SECONDS_TO_EXIT)
        for _ in range(_TRIES_TO_END):
            if not self._thread.is_alive():
                break
            ctypes.pythonapi.PyThreadState_SetAsyncExc(ctypes.c_ulong(self._thread.ident), ctypes.py_object(SystemExit))
            wake()
            self._thread.join(_SECONDS_PER_TRY)
        self._turn = False
        return not self._thread.is_alive()
