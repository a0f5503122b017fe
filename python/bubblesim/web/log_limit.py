# SPDX-License-Identifier: BSD-3-Clause
"""Limits the log lines about connections, which anyone can open."""

from __future__ import annotations

import logging
import sys
import time

from bubblesim.program.output import write_line

_MOST = 10  # records in a period
_PERIOD = 60.0  # s
_LOGGERS = ("aiohttp.server", "aiohttp.web", "aiohttp.websocket", "aiohttp.internal", "asyncio")


class _Limit(logging.Filter):
    """Lets a few records pass in each period, then logs that it leaves out others."""

    def __init__(self) -> None:
        super().__init__()
        self._begin = -_PERIOD
        self._passed = 0

    def filter(self, record: logging.LogRecord) -> bool:
        now = time.monotonic()
        if now - self._begin >= _PERIOD:
            self._begin = now
            self._passed = 0
        self._passed += 1
        if self._passed == _MOST + 1:
            write_line(sys.stderr, "warning: more errors of connections to the window are left out for one minute")
        return self._passed <= _MOST


def limit_log() -> None:
    """Limit what aiohttp and asyncio log."""
    limit = _Limit()
    for name in _LOGGERS:
        logging.getLogger(name).addFilter(limit)  # filters of a logger do not apply to those below it
