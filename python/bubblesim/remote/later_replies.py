# SPDX-License-Identifier: BSD-3-Clause
"""What a function returns whose reply comes later."""

from __future__ import annotations

from collections.abc import Callable, Generator
from dataclasses import dataclass
from typing import Any

Conversation = Generator[tuple[str, tuple[Any, ...]], Any, Any]
"""A call that calls functions of the client, yielding name and arguments; it returns the result of the call."""


@dataclass
class Pending:
    """A call that is answered later."""

    is_done: Callable[[], bool]
    """Asked after each step and after commands."""
    result: Callable[[], Any] = lambda: None
    accepts_the_end: bool = False
    """The end of the simulator is what the client asked for."""
    due: float | None = None
    """Of ``time.monotonic``, s: when it is done at the latest, asked then, too; None: steps and commands suffice."""
