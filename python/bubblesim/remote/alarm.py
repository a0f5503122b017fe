# SPDX-License-Identifier: BSD-3-Clause
"""Wakes the server when a wait for wall time is over."""

from __future__ import annotations

import threading
import time
from collections.abc import Callable

_LONGEST_SLEEP = 3600.0  # s; the times of threading have a limit


class Alarm:
    """Calls a function at the earliest of the times that were set, in a thread of its own.

    It remembers one time only: after each call, set the next one.
    """

    def __init__(self, ring: Callable[[], None]) -> None:
        """Begin without a time, and without the thread."""
        self._ring = ring
        self._changed = threading.Condition()
        self._time: float | None = None
        self._thread: threading.Thread | None = None
        self._closed = False

    def set(self, when: float) -> None:
        """Ring at this time of ``time.monotonic``, s, unless an earlier one is set."""
        with self._changed:
            if self._closed or (self._time is not None and self._time <= when):
                return
            self._time = when
            if self._thread is None:
                self._thread = threading.Thread(target=self._run, name="remote alarm", daemon=True)
                self._thread.start()
            self._changed.notify()

    def close(self) -> None:
        """End the thread; the function is not called any more."""
        with self._changed:
            self._closed = True
            self._changed.notify()
        if self._thread is not None:
            self._thread.join()

    def _run(self) -> None:
        while True:
            with self._changed:
                while not self._closed and (rest := self._rest()) > 0.0:
                    self._changed.wait(min(rest, _LONGEST_SLEEP))
                if self._closed:
                    return
                self._time = None
            self._ring()

    def _rest(self) -> float:
        return _LONGEST_SLEEP if self._time is None else self._time - time.monotonic()
