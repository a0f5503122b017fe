# SPDX-License-Identifier: BSD-3-Clause
"""Threads started by scripts."""

from __future__ import annotations

import sys
import threading
import time

from bubblesim.program.output import write_line

_SECONDS_TO_END = 1.0


def ended() -> bool:
    """Wait briefly for non-daemon threads; warn about those that do not end. Return whether all ended."""
    deadline = time.monotonic() + _SECONDS_TO_END
    others = [t for t in threading.enumerate() if not t.daemon and t is not threading.current_thread()]
    for thread in others:
        thread.join(max(0.0, deadline - time.monotonic()))
    left = [thread.name for thread in others if thread.is_alive()]
    if left:
        write_line(sys.stderr, f"warning: threads of scripts did not end: {', '.join(left)}")
        for stream in (sys.stdout, sys.stderr):
            stream.flush()
    return not left
