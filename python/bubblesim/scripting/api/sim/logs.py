# SPDX-License-Identifier: BSD-3-Clause
"""`sim` functions for log messages."""

from __future__ import annotations

import sys
from typing import Any

from bubblesim.program.output import write_line
from bubblesim.scene_state import log
from bubblesim.scripting.api.sim.context import ApiContext

_FLAGS = 0x3F000  # of a level: undecorated, onlyterminal, once


class LogFunctions(ApiContext):
    """The messages of all scripts are kept for viewers, the last 5000. Those up to the level
    sim.stringparam_verbosity, 'infos' unless it is set, are also written to the terminal."""

    def addLog(self, level: Any, text: Any) -> None:
        """Write a message with a level, sim.verbosity_errors to verbosity_trace; errors and warnings go to stderr.

        Add to the level sim.verbosity_undecorated to omit level and object in the terminal, verbosity_onlyterminal to
        keep it out of the window, verbosity_once to write a string once only.
        """
        number = level if isinstance(level, int) else self.verbosity_infos
        shown = _text_of(text)
        plain = number & ~_FLAGS
        shared = self._caller.shared
        if number & self.verbosity_once and not shared.log.is_first(plain, shown):
            return
        if not number & self.verbosity_onlyterminal:
            shared.log.add(plain, self._caller.object_path, shown)
        if plain > shared.log.verbosity:
            return
        errors = (self.verbosity_errors, self.verbosity_scripterrors)
        warnings = (self.verbosity_warnings, self.verbosity_scriptwarnings)
        kind = "error" if plain in errors else "warning" if plain in warnings else "info"
        decoration = "" if number & self.verbosity_undecorated else f"{kind}: {self._caller.object_path}: "
        write_line(sys.stdout if kind == "info" else sys.stderr, f"{decoration}{shown}")

    def addStatusbarMessage(self, text: Any) -> None:
        """Write a message."""
        self.addLog(self.verbosity_scriptinfos, text)

    def getLog(self, since: int = 0, most: int = 1000) -> dict[str, Any]:
        """Return the messages after number ``since`` for viewers, at most the last ``most``.

        The result has ``last``, to pass next time, and ``entries`` with ``number``, ``time`` (simulated s), ``level``,
        ``object`` (path) and ``text``: what scripts print (level verbosity_scriptinfos; to stderr
        verbosity_scriptwarnings), log messages, and errors of scripts.
        """
        return self._caller.shared.log.since(since, most)

    def _verbosity(self) -> str:
        return next(name for name, level in log.LEVELS.items() if level == self._caller.shared.log.verbosity)

    def _set_verbosity(self, name: str) -> None:
        if name not in log.LEVELS:
            raise ValueError(f"'{name}' is not a verbosity; valid ones: {', '.join(log.LEVELS)}")
        self._caller.shared.log.verbosity = log.LEVELS[name]


def _text_of(value: Any) -> str:
    if isinstance(value, bytes):
        return value.decode(errors="backslashreplace")
    try:
        return str(value)
    except Exception:
        return object.__repr__(value)
