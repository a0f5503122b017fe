# SPDX-License-Identifier: BSD-3-Clause
"""Calls of `os` that scripts must not make: they would end, replace or double the simulator that runs the script."""

from __future__ import annotations

import os
from typing import Any, NoReturn

_DOUBLES = "would make a second simulator; start a program by sim.launchExecutable or subprocess"
_ENDS = "would end the simulator without sysCall_cleanup and without leaving ROS; use sim.quitSimulator()"
_REPLACES = "would put another program in the simulator's place; start it by sim.launchExecutable or subprocess"
_REFUSED = {
    "fork": _DOUBLES,
    "forkpty": _DOUBLES,
    "_exit": _ENDS,
    "abort": _ENDS,
    "execv": _REPLACES,  # which all others of its kind call, or the next
    "execve": _REPLACES,
}

_exit = os._exit
_process = os.getpid()


class RefusedCallError(RuntimeError):
    """A script called one of them."""


def install() -> None:
    """From now on these functions raise RefusedCallError."""
    for name, why in _REFUSED.items():
        setattr(os, name, _refusing(name, why))


def _refusing(name: str, why: str) -> Any:
    def refuse(*arguments: object) -> NoReturn:
        raise RefusedCallError(f"os.{name} {why}")

    return refuse


def end_if_forked() -> None:
    """End a copy of the simulator that a script has made all the same, as by ctypes; to be called after its code."""
    if os.getpid() != _process:
        _exit(1)
