# SPDX-License-Identifier: BSD-3-Clause
"""Lines of text to the outside, whatever they hold and whoever listens."""

from __future__ import annotations

import contextlib
from typing import TextIO


def write_line(stream: TextIO, text: object) -> None:
    """Write a line of the simulator's own at once; a closed stream is no error."""
    plain = getattr(stream, "plain", stream)  # scripts write with a prefix
    with contextlib.suppress(OSError, ValueError):
        print(encodable(plain, str(text)), file=plain, flush=True)


def encodable(stream: TextIO, text: str) -> str:
    """The text, with escapes for what the stream cannot encode."""
    encoding = getattr(stream, "encoding", None) or "utf-8"
    return text.encode(encoding, errors="backslashreplace").decode(encoding)
