# SPDX-License-Identifier: BSD-3-Clause
"""Stop requests by signals, and waiting until then."""

from __future__ import annotations

import signal
import time
from collections.abc import Callable

from bubblesim.running.processes import Programs, RunError
from bubblesim.running.progress import Progress

_START_TIMEOUT = 30.0  # s


class Stop:
    """Set by the first SIGINT, SIGTERM or SIGHUP; an ignored SIGHUP, as with nohup, stays ignored."""

    def __init__(self) -> None:
        """Install the signal handlers."""
        self.requested = False
        for number in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP):
            if number != signal.SIGHUP or signal.getsignal(number) != signal.SIG_IGN:
                signal.signal(number, self._request)

    def _request(self, number: int, frame: object) -> None:
        self.requested = True


def wait_for(condition: Callable[[], bool], what: str, programs: Programs, stop: Stop) -> None:
    """Return when the condition holds or a stop is requested; raise RunError after a timeout."""
    deadline = time.monotonic() + _START_TIMEOUT
    with Progress(f"waiting for {what}") as progress:
        while not condition() and not stop.requested:
            programs.check()
            if time.monotonic() > deadline:
                raise RunError(f"timeout after {_START_TIMEOUT:.0f} s waiting for {what}")
            progress.show()
            time.sleep(0.05)
