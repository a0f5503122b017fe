# SPDX-License-Identifier: BSD-3-Clause
"""A line that says what keeps a user waiting."""

from __future__ import annotations

import sys
import time
from types import TracebackType

_UNNOTICED = 2.0  # s, for which nobody wonders


class Progress:
    """On a terminal, a line on stderr as long as the block lasts; nothing before two seconds, nor anywhere else."""

    def __init__(self, what: str) -> None:
        """Begins to count."""
        self._what = what
        self._begin = time.monotonic()
        self._shown = -1

    def show(self) -> None:
        """To be called again and again."""
        seconds = int(time.monotonic() - self._begin)
        if seconds >= _UNNOTICED and seconds != self._shown and sys.stderr.isatty():
            self._shown = seconds
            print(f"\r\033[K{self._what} ... {seconds} s", end="", file=sys.stderr, flush=True)

    def __enter__(self) -> Progress:
        """The block that is waited in."""
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, traceback: TracebackType | None
    ) -> None:
        """Takes the line away."""
        if self._shown >= 0:
            print("\r\033[K", end="", file=sys.stderr, flush=True)
