# SPDX-License-Identifier: BSD-3-Clause
"""Coloured terminal output."""

from __future__ import annotations

import os
from typing import TextIO

_CODES = {"bold": "1", "red": "31", "green": "32", "yellow": "33"}


def painted(text: str, color: str, stream: TextIO) -> str:
    """Return the text in a colour if the stream is a terminal and NO_COLOR is not set, else unchanged."""
    if not stream.isatty() or os.environ.get("NO_COLOR") or os.environ.get("TERM") == "dumb":
        return text
    return f"\033[{_CODES[color]}m{text}\033[0m"
