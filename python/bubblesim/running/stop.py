# SPDX-License-Identifier: BSD-3-Clause
"""The end that a user wants, and waiting for something until then."""

from __future__ import annotations

import signal
import time
from collections.abc import Callable

from bubblesim.running.processes import Programs, RunError
from bubblesim.running.progress import Progress

_STARTING_PATIENCE = 30.0  # s


class Stop:
    """Becomes true at the first SIGINT, SIGTERM or SIGHUP; a SIGHUP that is ignored, as by nohup, stays so."""

    def __init__(self) -> None:
        """Takes the signals over."""
        self.requested = False
        for number in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP):
            if number != signal.SIGHUP or signal.getsignal(number) != signal.SIG_IGN:
                signal.signal(number, self._request)

    def _request(self, number: int, frame: object) -> None:
        self.requested = True


def wait_for(condition: Callable[[], bool], what: str, programs: Programs, stop: Stop) -> None:
    """Returns when the condition holds or a stop is requested; RunError when it takes too long."""
    deadline = time.monotonic() + _STARTING_PATIENCE
    with Progress(f"waiting for {what}") as progress:
        while not condition() and not stop.requested:
            programs.check()
            if time.monotonic() > deadline:
                raise RunError(f"waited {_STARTING_PATIENCE:.0f} s in vain for {what}")
            progress.show()
            time.sleep(0.05)
