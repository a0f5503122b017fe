# SPDX-License-Identifier: BSD-3-Clause
"""Robust output of lines of text."""

from __future__ import annotations

import contextlib
from typing import TextIO


def write_line(stream: TextIO, text: object) -> None:
    """Write a line of the simulator and flush; ignore a closed stream."""
    plain = getattr(stream, "plain", stream)  # streams of scripts add a prefix
    with contextlib.suppress(OSError, ValueError):
        print(encodable(plain, str(text)), file=plain, flush=True)


def encodable(stream: TextIO, text: str) -> str:
    """Return the text with escapes for characters that the stream cannot encode."""
    encoding = getattr(stream, "encoding", None) or "utf-8"
    return text.encode(encoding, errors="backslashreplace").decode(encoding)
