# SPDX-License-Identifier: BSD-3-Clause
"""The names of the callbacks of child scripts."""

from __future__ import annotations

import difflib

from bubblesim.messages.names import did_you_mean

PAUSE_HOOKS = ("sysCall_suspend", "sysCall_suspended", "sysCall_resume")
HOOKS = (
    "sysCall_init",
    "sysCall_thread",
    "sysCall_actuation",
    "sysCall_sensing",
    "sysCall_reset",
    "sysCall_cleanup",
    "sysCall_vision",
    *PAUSE_HOOKS,
)

_PREFIX = "sysCall_"
# CoppeliaSim's callbacks for other kinds of scripts and for unsupported events, with the callback to use instead.
IN_PLACE_OF = {
    "sysCall_afterSimulation": "sysCall_cleanup",
    "sysCall_beforeSimulation": "sysCall_init",
    "sysCall_contact": "sysCall_sensing",
    "sysCall_contactCallback": "sysCall_sensing",
    "sysCall_dyn": "sysCall_actuation",
    "sysCall_dynCallback": "sysCall_actuation",
    "sysCall_joint": "sysCall_actuation",
    "sysCall_jointCallback": "sysCall_actuation",
    "sysCall_trigger": "sysCall_sensing",
}


def looks_like_callback(name: str) -> bool:
    """Return whether a global function has the name of a callback."""
    return name.startswith(_PREFIX)


def never_called(name: str) -> str:
    """Return the warning about a function that is named like a callback but is not one."""
    if name in IN_PLACE_OF:
        return f"{name} is never called; use {IN_PLACE_OF[name]} instead"
    bare = [hook.removeprefix(_PREFIX) for hook in HOOKS]
    near = difflib.get_close_matches(name.removeprefix(_PREFIX), bare, n=1)
    hint = did_you_mean([_PREFIX + each for each in near]) or f"; the callbacks are {', '.join(HOOKS)}"
    return f"{name} is never called{hint}"
