# SPDX-License-Identifier: BSD-3-Clause
"""The messages of scripts, kept for readers such as the window: printed lines, log messages, errors."""

from __future__ import annotations

import itertools
import threading
from collections import deque
from collections.abc import Callable
from dataclasses import asdict, dataclass
from typing import Any

ERROR, WARNING, SCRIPT_ERROR, SCRIPT_WARNING, PRINTED, INFO, DEBUG, TRACE = 200, 300, 420, 430, 450, 500, 600, 700
"""Levels of messages; those of sim.verbosity_."""
LEVELS = {
    "none": 100,
    "errors": ERROR,
    "warnings": WARNING,
    "loadinfos": 400,
    "scripterrors": SCRIPT_ERROR,
    "scriptwarnings": SCRIPT_WARNING,
    "scriptinfos": PRINTED,
    "msgs": PRINTED,
    "infos": INFO,
    "debug": DEBUG,
    "trace": TRACE,
}
_MOST = 5000
_MOST_CHARACTERS = 10_000  # of one message


@dataclass(frozen=True)
class Entry:
    """A message."""

    number: int
    """Counted from 1."""
    time: float
    """Simulated s."""
    level: int
    object: str
    """Path of the script's object, or the name of a remote client."""
    text: str


class Log:
    """The last messages. Threads of scripts write to it, too."""

    def __init__(self, clock: Callable[[], float] = lambda: 0.0) -> None:
        """Create it empty; ``clock`` returns the simulated time, s."""
        self.verbosity = INFO
        """Level up to which messages are written to the terminal."""
        self._clock = clock
        self._entries: deque[Entry] = deque(maxlen=_MOST)
        self._written = 0
        self._once: dict[tuple[int, int], None] = {}  # hashes of strings by level, in the order of their writing
        self._lock = threading.Lock()
        self._unfinished: dict[tuple[int, str], str] = {}  # by level and object

    def add(self, level: int, source: str, text: str) -> None:
        """Add a message of an object or client."""
        shown = text if len(text) <= _MOST_CHARACTERS else text[:_MOST_CHARACTERS] + " ..."
        with self._lock:
            self._written += 1
            self._entries.append(Entry(self._written, self._clock(), level, source, shown))

    def is_first(self, level: int, text: str) -> bool:
        """Return whether a string that is to be written once was not written before; the last 5000 are remembered."""
        key = level, hash(text)
        if key in self._once:
            return False
        if len(self._once) >= _MOST:
            del self._once[next(iter(self._once))]
        self._once[key] = None
        return True

    def add_written(self, level: int, source: str, text: str) -> None:
        """Add what was written to a stream: each complete line is a message."""
        *lines, rest = (self._unfinished.pop((level, source), "") + text).split("\n")
        if len(rest) > _MOST_CHARACTERS:
            lines, rest = [*lines, rest], ""
        if rest:
            self._unfinished[level, source] = rest
        for line in lines:
            self.add(level, source, line)

    def since(self, number: int, most: int) -> dict[str, Any]:
        """Return the messages after a number, at most the last ``most`` of them, and the number of the last one."""
        with self._lock:
            newer = list(itertools.takewhile(lambda entry: entry.number > number, reversed(self._entries)))
            return {"last": self._written, "entries": [asdict(entry) for entry in reversed(newer[: max(0, most)])]}
