# SPDX-License-Identifier: BSD-3-Clause
"""The names of the callbacks of child scripts."""

from __future__ import annotations

import difflib

from bubblesim.messages.names import did_you_mean

PAUSE_HOOKS = ("sysCall_suspend", "sysCall_suspended", "sysCall_resume")
SUBSTEP_HOOKS = ("sysCall_dyn", "sysCall_joint", "sysCall_contact")
HOOKS = (
    "sysCall_init",
    "sysCall_thread",
    "sysCall_actuation",
    "sysCall_sensing",
    "sysCall_reset",
    "sysCall_cleanup",
    "sysCall_vision",
    "sysCall_trigger",
    "sysCall_beforeSimulation",
    "sysCall_afterSimulation",
    "sysCall_msg",
    *SUBSTEP_HOOKS,
    *PAUSE_HOOKS,
)
OLD_NAMES = {
    "sysCall_thread": "sysCall_threadmain",
    "sysCall_dyn": "sysCall_dynCallback",
    "sysCall_joint": "sysCall_jointCallback",
    "sysCall_contact": "sysCall_contactCallback",
}

_PREFIX = "sysCall_"


def looks_like_callback(name: str) -> bool:
    """Return whether a global function has the name of a callback."""
    return name.startswith(_PREFIX)


def never_called(name: str) -> str:
    """Return the warning about a function that is named like a callback but is not one."""
    bare = [hook.removeprefix(_PREFIX) for hook in HOOKS]
    near = difflib.get_close_matches(name.removeprefix(_PREFIX), bare, n=1)
    hint = did_you_mean([_PREFIX + each for each in near]) or f"; the callbacks are {', '.join(HOOKS)}"
    return f"{name} is never called{hint}"
