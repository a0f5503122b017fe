# SPDX-License-Identifier: BSD-3-Clause
"""The sysCall_thread of a Lua script: a coroutine, which yields its turn inside of the functions that it calls."""

from __future__ import annotations

import contextlib
import threading
import time
from collections.abc import Callable, Iterator

from bubblesim.scripting.threads.script_thread import SLICE, by_ident, plain_sleep

_SECONDS_TO_END = 0.8
_LAST_SLICE = 0.2  # s: there is no turn after it in which the thread could go on to its end


class LuaThread:
    """Like ScriptThread, but runs completely in the simulation's thread, so it must not wait."""

    def __init__(self, resume: Callable[[], bool]) -> None:
        """Create a thread that starts in its first turn.

        :param resume: resumes the coroutine; returns true when it has ended.
        """
        self.stepping = 0  # depth of nested setStepping calls
        self.slice = SLICE  # s of wall time: its waiting is the simulation's
        self.exit_requested = False
        self.ident = None
        self._resume = resume
        self._done = False
        self._turn_began = 0.0  # by time.monotonic()
        self._steps = False
        self._must_end = float("inf")

    def run_turn(self) -> None:
        """Run the thread until it steps, ends, or calls a function after its time slice; raise its error."""
        if self._done:
            return
        self._turn_began, self._steps = time.monotonic(), False
        me = threading.get_ident()
        by_ident[me] = self
        try:
            self._done = self._resume()
        except BaseException:
            self._done = True
            raise
        finally:
            del by_ident[me]

    def turn_is_over(self) -> bool:
        """Return whether the coroutine, which has just called a function, has to yield its turn."""
        if self._done or by_ident.get(threading.get_ident()) is not self:
            return False
        return self._steps or (not self.stepping and time.monotonic() >= self._turn_began + self.slice)

    @contextlib.contextmanager
    def turn(self) -> Iterator[None]:
        """Do nothing: the coroutine only runs in its turns."""
        yield

    def step(self) -> None:
        """End the turn after the current call; called by the thread."""
        self._steps = True

    def sleep(self, seconds: float) -> None:
        """Sleep; Python functions called by the thread block the simulation's thread."""
        plain_sleep(seconds)

    def check_exit(self) -> None:
        """Check whether the thread has to end; called while Lua runs.

        :raises TimeoutError: if it did not end in time after a request.
        """
        if time.monotonic() > self._must_end:
            raise TimeoutError

    def end(self, wake: Callable[[], None]) -> bool:
        """Request the thread to end and run it for a last turn; return whether it ended in time."""
        self.exit_requested = True
        self._must_end = time.monotonic() + _SECONDS_TO_END
        self.slice = max(self.slice, _LAST_SLICE)
        running = by_ident.get(threading.get_ident()) is self
        if running or self._done:
            return True
        try:
            self.run_turn()
        except Exception:
            return time.monotonic() <= self._must_end
        finally:
            self._done = True
        return True
