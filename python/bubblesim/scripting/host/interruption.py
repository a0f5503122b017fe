# SPDX-License-Identifier: BSD-3-Clause
"""Breaks off a script that keeps the simulator from ending, or from a stop."""

from __future__ import annotations

import signal
from collections.abc import Callable
from types import FrameType

allowed = False
"""Whether the code of a script runs, which is where KeyboardInterrupt may come up."""

requested = False
"""Whether a script was broken off: then no more is to be begun but what must be done at the end."""


for_stop = False
"""Whether a script was just broken off for a stop that waits for it."""

# It does nothing in programs that do not handle it, and the simulator's own do not use it.
_WAKE_UP = signal.SIGURG
_still_wanted: Callable[[], bool] = bool  # no


def install() -> None:
    """Have interruptions raise KeyboardInterrupt in the script that runs."""
    signal.signal(signal.SIGINT, _interrupt)
    signal.signal(_WAKE_UP, _break_off_for_stop)


def break_off(thread: int, still_wanted: Callable[[], bool]) -> None:
    """Raise KeyboardInterrupt in the simulation's thread, if it is still wanted there; from another thread.

    :param thread: the simulation's; a signal for it also ends a sleep.
    """
    global _still_wanted
    _still_wanted = still_wanted
    signal.pthread_kill(thread, _WAKE_UP)


def _break_off_for_stop(number: int, frame: FrameType | None) -> None:
    global for_stop, _still_wanted
    wanted, _still_wanted = _still_wanted, bool
    if allowed and wanted():
        for_stop = True
        raise KeyboardInterrupt


def _interrupt(number: int, frame: FrameType | None) -> None:
    global requested
    if allowed:
        requested = True
        raise KeyboardInterrupt
