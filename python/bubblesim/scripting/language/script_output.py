# SPDX-License-Identifier: BSD-3-Clause
"""What scripts print: each line begins with the script's object and the simulation time."""

from __future__ import annotations

import contextlib
import errno
import sys
import threading
from collections.abc import Callable, Iterator
from types import FrameType
from typing import Any, TextIO

from bubblesim.output import encodable, write_line

prefixes: dict[str, Callable[[], str]] = {}
"""What the lines of a script begin with, by the name of the module that it is in Python."""

lost = False
"""Whether something that a script printed to stdout could not be written."""


class ScriptStream:
    """Stands before stdout or stderr: lines of scripts get their prefix, all else goes through as it is.

    What a script writes shows at once; when another begins while a line is unfinished, that line ends there.
    """

    def __init__(self, stream: TextIO) -> None:
        """Write to ``stream``, which is known as ``plain`` from now on."""
        self.plain = stream
        self._lock = threading.RLock()
        self._unfinished = ""  # the prefix of the line that has not ended yet

    def __getattr__(self, name: str) -> Any:
        """All but writing."""
        return getattr(self.plain, name)

    def write(self, text: str) -> int:
        """Write what the script that calls wants to say, or somebody else."""
        prefix = _prefix(sys._getframe(1))
        return self.plain.write(text) if prefix is None else self.write_of(prefix, text)

    def flush(self) -> None:
        """Nothing waits: what could be written is, and what could not was reported."""
        with contextlib.suppress(OSError, ValueError):
            self.plain.flush()

    def writelines(self, lines: list[str]) -> None:
        """Write one after the other."""
        self.write("".join(lines))

    def write_of(self, prefix: str, text: str) -> int:
        """Write what somebody wants to say whose lines begin with ``prefix``."""
        with self._lock, self._reported_losses():
            begun = self._unfinished
            if begun and begun.partition(" ")[0] != prefix.partition(" ")[0]:
                self.plain.write("\n")
                begun = ""
            lines = encodable(self.plain, text).splitlines(keepends=True)
            self.plain.write("".join(("" if begun and not n else prefix) + line for n, line in enumerate(lines)))
            if lines:
                self._unfinished = "" if lines[-1].endswith("\n") else prefix
        return len(text)

    @contextlib.contextmanager
    def _reported_losses(self) -> Iterator[None]:
        """A script goes on when nobody reads what it prints; the run does not succeed then."""
        global lost
        try:
            yield
        except (OSError, ValueError) as error:
            # A closed terminal and a reader that has seen enough lose nothing that anybody wants.
            if self.plain is sys.__stdout__ and getattr(error, "errno", None) not in (errno.EIO, errno.EPIPE):
                if not lost:
                    write_line(sys.stderr, f"error: cannot write what scripts print to stdout: {error}")
                lost = True


def print_line(prefix: str, line: str) -> None:
    """Print a line of a script that is not in Python."""
    if isinstance(sys.stdout, ScriptStream):
        sys.stdout.write_of(prefix, f"{line}\n")
    else:
        print(f"{prefix}{line}")


def install() -> None:
    """From now on scripts print with their prefix."""
    for name in ("stdout", "stderr"):
        stream = getattr(sys, name)
        if stream is not None and not isinstance(stream, ScriptStream):
            setattr(sys, name, ScriptStream(stream))


def _prefix(frame: FrameType | None) -> str | None:
    """That of the script whose code is on the stack, be it that of a thread that it started."""
    while frame is not None:
        prefix = prefixes.get(frame.f_globals.get("__name__", ""))
        if prefix is not None:
            return prefix()
        frame = frame.f_back
    return None
