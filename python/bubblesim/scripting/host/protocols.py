# SPDX-License-Identifier: BSD-3-Clause
"""What a child script and the watchdog need of the host that keeps the scripts, and the watchdog of a script."""

from __future__ import annotations

from pathlib import Path
from typing import Any, Protocol

from bubblesim.scripting.caller import Caller, SharedData


class RunningScript(Protocol):
    """A script whose code is on the call stack."""

    object_path: str
    doing: str
    """The callback that it was called for."""
    stuck_at: str
    """FILE:LINE where the watchdog found it last."""

    def where_now(self, thread: int) -> str:
        """Return FILE:LINE where it is now, or nothing."""


class Host(Protocol):
    """The keeper of all scripts of a simulation."""

    simulation: Any
    search_paths: list[Path]
    lua_unsafe: bool
    allowed_programs: list[str]
    shared: SharedData
    calls: int
    """Calls of scripts so far."""
    failures: int
    running_script: Any
    """The RunningScript, or None."""

    def make_modules(self, script: Caller) -> dict[str, Any]:
        """Return the modules that a script finds among its globals."""

    def count_disabled(self) -> None:
        """Count the disabled scripts again."""

    def stop_waits(self) -> bool:
        """Return whether a stop or a reset waits for the script that runs; for any thread."""
