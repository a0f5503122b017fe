# SPDX-License-Identifier: BSD-3-Clause
"""Lines of text to the outside, whatever they hold and whoever listens."""

from __future__ import annotations

import contextlib
from typing import TextIO


def write_line(stream: TextIO, text: object) -> None:
    """Write a line at once; what the stream cannot encode is written as escapes, and a closed stream is no error."""
    encoding = getattr(stream, "encoding", None) or "utf-8"
    line = str(text).encode(encoding, errors="backslashreplace").decode(encoding)
    with contextlib.suppress(OSError, ValueError):
        print(line, file=stream, flush=True)
