# SPDX-License-Identifier: BSD-3-Clause
"""Functions of `os` that scripts must not call: they would end, replace or duplicate the simulator."""

from __future__ import annotations

import os
from typing import Any, NoReturn

_DOUBLES = "would duplicate the simulator; start programs with sim.launchExecutable or subprocess"
_ENDS = "would end the simulator without sysCall_cleanup and without unregistering from ROS; use sim.quitSimulator()"
_REPLACES = "would replace the simulator; start programs with sim.launchExecutable or subprocess"
_FORBIDDEN = {
    "fork": _DOUBLES,
    "forkpty": _DOUBLES,
    "_exit": _ENDS,
    "abort": _ENDS,
    "execv": _REPLACES,  # called by the other exec functions, as is execve
    "execve": _REPLACES,
}

_exit = os._exit
_process = os.getpid()


class ForbiddenCallError(RuntimeError):
    """A script called one of these functions."""


def install() -> None:
    """Replace these functions by ones that raise ForbiddenCallError."""
    for name, why in _FORBIDDEN.items():
        setattr(os, name, _forbidding(name, why))


def _forbidding(name: str, why: str) -> Any:
    def refuse(*arguments: object) -> NoReturn:
        raise ForbiddenCallError(f"os.{name} {why}")

    return refuse


def end_if_forked() -> None:
    """End a copy of the simulator forked by a script, for example with ctypes; call it after script code."""
    if os.getpid() != _process:
        _exit(1)
