# SPDX-License-Identifier: BSD-3-Clause
"""Breaks off a script that keeps the simulator from ending."""

from __future__ import annotations

import signal
from types import FrameType

allowed = False
"""Whether the code of a script runs, which is where KeyboardInterrupt may come up."""

requested = False
"""Whether a script was broken off: then no more is to be begun but what must be done at the end."""


def install() -> None:
    """Have interruptions raise KeyboardInterrupt in the script that runs."""
    signal.signal(signal.SIGINT, _interrupt)


def _interrupt(number: int, frame: FrameType | None) -> None:
    global requested
    if allowed:
        requested = True
        raise KeyboardInterrupt
