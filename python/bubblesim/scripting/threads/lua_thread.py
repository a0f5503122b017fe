# SPDX-License-Identifier: BSD-3-Clause
"""The sysCall_thread of a script in Lua: a coroutine, which gives its turn back inside the functions that it calls."""

from __future__ import annotations

import contextlib
import threading
import time
from collections.abc import Callable, Iterator

from bubblesim.scripting.threads.script_thread import SLICE, by_ident, plain_sleep

_SECONDS_TO_END = 0.8


class LuaThread:
    """As ScriptThread, but all of it runs in the simulation's thread, so that it must not wait for anything."""

    def __init__(self, resume: Callable[[], bool]) -> None:
        """Make a thread that begins in its first turn.

        :param resume: lets the coroutine go on; true when it has ended.
        """
        self.stepping = 0  # how often it asked to keep its turns until it gives them back
        self.exit_requested = False
        self.ident = None
        self._resume = resume
        self._done = False
        self._turn_ends = 0.0  # by time.monotonic()
        self._must_end = float("inf")

    def give_turn(self) -> None:
        """Let the thread work until it steps, ends, or calls a function when its slice is over; raise its error."""
        if self._done:
            return
        self._turn_ends = time.monotonic() + SLICE
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
        """Whether the coroutine, which has just called a function, is to give its turn back."""
        if self._done or by_ident.get(threading.get_ident()) is not self:
            return False
        return self._turn_ends <= 0.0 or (not self.stepping and time.monotonic() >= self._turn_ends)

    @contextlib.contextmanager
    def turn(self) -> Iterator[None]:
        """It only runs in its turns."""
        yield

    def step(self) -> None:
        """Called by the thread: its turn is over when the call is."""
        self._turn_ends = 0.0

    def sleep(self, seconds: float) -> None:
        """What Python does for the thread may sleep; the simulation's own thread is what sleeps then."""
        plain_sleep(seconds)

    def check_that_it_may_go_on(self) -> None:
        """Called while Lua runs.

        :raises TimeoutError: when it was asked to end and has not in time.
        """
        if time.monotonic() > self._must_end:
            raise TimeoutError

    def end(self, wake: Callable[[], None]) -> bool:
        """Let the thread see that it is asked to end, in a last turn; whether that turn came to an end by itself."""
        self.exit_requested = True
        self._must_end = time.monotonic() + _SECONDS_TO_END
        running = by_ident.get(threading.get_ident()) is self
        if running or self._done:
            return True
        try:
            self.give_turn()
        except Exception:
            return time.monotonic() <= self._must_end
        finally:
            self._done = True
        return True
