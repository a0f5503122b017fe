# SPDX-License-Identifier: BSD-3-Clause
"""Interrupts a script that blocks the end of the simulator, or a stop."""

from __future__ import annotations

import signal
from collections.abc import Callable
from types import FrameType

from bubblesim.scripting.host import kept_signals

allowed = False
"""Whether script code runs, so that KeyboardInterrupt may be raised."""

requested = False
"""Whether a script was interrupted because the simulator ends: only clean-up code is called then."""


for_stop = False
"""Whether a script was just interrupted for a pending stop."""

# Ignored by programs without a handler, and not used elsewhere in the simulator.
_WAKE_UP = signal.SIGURG
_still_needed: Callable[[], bool] = bool  # returns False


def install(interruption: int) -> None:
    """Install signal handlers that raise KeyboardInterrupt in the running script: at its end, by this signal."""
    signal.signal(interruption, _interrupt)
    signal.signal(_WAKE_UP, _break_off_for_stop)
    kept_signals.install(interruption, _WAKE_UP)


def break_off(thread: int, still_needed: Callable[[], bool]) -> None:
    """Raise KeyboardInterrupt in the simulation's thread, if ``still_needed()`` is true there; for other threads.

    :param thread: the simulation's thread; the signal also ends a sleep.
    """
    global _still_needed
    _still_needed = still_needed
    signal.pthread_kill(thread, _WAKE_UP)


def _break_off_for_stop(number: int, frame: FrameType | None) -> None:
    global for_stop, _still_needed
    wanted, _still_needed = _still_needed, bool
    if allowed and wanted():
        for_stop = True
        raise KeyboardInterrupt


def _interrupt(number: int, frame: FrameType | None) -> None:
    global requested
    if allowed:
        requested = True
        raise KeyboardInterrupt
