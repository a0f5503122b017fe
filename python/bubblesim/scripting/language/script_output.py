# SPDX-License-Identifier: BSD-3-Clause
"""Output of scripts: each line starts with the script's object and the simulation time."""

from __future__ import annotations

import contextlib
import errno
import sys
import threading
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from types import FrameType
from typing import Any, TextIO

from bubblesim.program.output import encodable, write_line
from bubblesim.scene_state import log


@dataclass(frozen=True)
class Source:
    """The script that printed lines come from."""

    object_path: str
    clock: Callable[[], float]
    """Returns the simulated time, s."""
    record: Callable[[int, str, str], None]
    """Called with level, object path and text; see Log.add_written."""

    def prefix(self) -> str:
        """Return the beginning of a line."""
        return f"[{self.object_path} {self.clock():.3f} s] "


sources: dict[str, Source] = {}
"""The scripts in Python, by module name."""

lost = False
"""Whether output of a script to stdout could not be written."""


class ScriptStream:
    """Wraps stdout or stderr: adds the prefix to lines of scripts, and passes other output unchanged.

    Output of a script is written at once; if other output follows an incomplete line, a line break is added.
    """

    def __init__(self, stream: TextIO) -> None:
        """Write to ``stream``, available as ``plain``."""
        self.plain = stream
        self._lock = threading.RLock()
        self._unfinished = ""  # prefix of the incomplete line

    def __getattr__(self, name: str) -> Any:
        """Forward all attributes except writing."""
        return getattr(self.plain, name)

    def write(self, text: str) -> int:
        """Write text, with the prefix of the calling script if there is one."""
        source = _source(sys._getframe(1))
        return self.plain.write(text) if source is None else self.write_of(source, text)

    def flush(self) -> None:
        """Flush; write errors have been reported already."""
        with contextlib.suppress(OSError, ValueError):
            self.plain.flush()

    def writelines(self, lines: list[str]) -> None:
        """Write all lines."""
        self.write("".join(lines))

    def write_of(self, source: Source, text: str) -> int:
        """Write text of a script with a prefix for each line, and record it."""
        prefix = source.prefix()
        level = log.PRINTED if self.plain is sys.__stdout__ else log.SCRIPT_WARNING
        source.record(level, source.object_path, text)
        with self._lock, self._reported_losses():
            unfinished = self._unfinished
            if unfinished and unfinished.partition(" ")[0] != prefix.partition(" ")[0]:
                self.plain.write("\n")
                unfinished = ""
            lines = encodable(self.plain, text).splitlines(keepends=True)
            self.plain.write("".join(("" if unfinished and not n else prefix) + line for n, line in enumerate(lines)))
            if lines:
                self._unfinished = "" if lines[-1].endswith("\n") else prefix
        return len(text)

    @contextlib.contextmanager
    def _reported_losses(self) -> Iterator[None]:
        """Continue the script when its output cannot be written, but let the run fail."""
        global lost
        try:
            yield
        except (OSError, ValueError) as error:
            # A closed terminal, or a reader that ended, is not an error.
            if self.plain is sys.__stdout__ and getattr(error, "errno", None) not in (errno.EIO, errno.EPIPE):
                if not lost:
                    write_line(sys.stderr, f"error: cannot write what scripts print to stdout: {error}")
                lost = True


def print_line(source: Source, line: str) -> None:
    """Print a line of a script that is not written in Python."""
    if isinstance(sys.stdout, ScriptStream):
        sys.stdout.write_of(source, f"{line}\n")
    else:
        print(f"{source.prefix()}{line}")


def install() -> None:
    """Add the prefix to output of scripts from now on."""
    for name in ("stdout", "stderr"):
        stream = getattr(sys, name)
        if stream is not None and not isinstance(stream, ScriptStream):
            setattr(sys, name, ScriptStream(stream))


def _source(frame: FrameType | None) -> Source | None:
    """Return the script whose code is on the stack, also in threads that it started."""
    while frame is not None:
        source = sources.get(frame.f_globals.get("__name__", ""))
        if source is not None:
            return source
        frame = frame.f_back
    return None
