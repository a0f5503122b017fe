# SPDX-License-Identifier: BSD-3-Clause
"""A progress line while the user waits."""

from __future__ import annotations

import sys
import time
from types import TracebackType

_DELAY = 2.0  # s without output


class Progress:
    """Shows a line on stderr during the block, on terminals only and after two seconds."""

    def __init__(self, what: str) -> None:
        """Start the timer."""
        self._what = what
        self._begin = time.monotonic()
        self._shown = -1

    def show(self) -> None:
        """Update the line; call it repeatedly."""
        seconds = int(time.monotonic() - self._begin)
        if seconds >= _DELAY and seconds != self._shown and sys.stderr.isatty():
            self._shown = seconds
            print(f"\r\033[K{self._what} ... {seconds} s", end="", file=sys.stderr, flush=True)

    def __enter__(self) -> Progress:
        """Start the block."""
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, traceback: TracebackType | None
    ) -> None:
        """Clear the line."""
        if self._shown >= 0:
            print("\r\033[K", end="", file=sys.stderr, flush=True)
