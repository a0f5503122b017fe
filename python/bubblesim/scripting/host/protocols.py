# SPDX-License-Identifier: BSD-3-Clause
"""Interfaces between the script host, child scripts and the watchdog."""

from __future__ import annotations

from pathlib import Path
from typing import Any, Protocol

from bubblesim.scene_state.problems import Problem
from bubblesim.scene_state.shared_data import SharedData
from bubblesim.scripting.caller import Caller


class RunningScript(Protocol):
    """A script whose code is on the call stack."""

    object_path: str
    activity: str
    """The callback that runs."""
    stuck_at: str
    """FILE:LINE where the watchdog found it."""

    def where_now(self, thread: int) -> str:
        """Return FILE:LINE of the running code, or an empty string."""


class Host(Protocol):
    """The host of all scripts of a simulation."""

    runner: Any
    simulation: Any
    search_paths: list[Path]
    lua_unsafe: bool
    allowed_programs: list[str]
    shared: SharedData
    calls: int
    """Number of calls of scripts."""
    failures: int
    running_script: Any
    """The RunningScript, or None."""

    def make_modules(self, script: Caller) -> dict[str, Any]:
        """Return the modules in a script's globals."""

    def count_disabled(self) -> None:
        """Update the number of disabled scripts."""

    def add_problem(self, problem: Problem) -> None:
        """Keep a problem of a script until it is loaded again."""

    def stop_waits(self) -> bool:
        """Return whether a stop or a reset waits for the running script; thread-safe."""
