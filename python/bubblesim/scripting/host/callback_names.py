# SPDX-License-Identifier: BSD-3-Clause
"""The names of the callbacks of child scripts."""

from __future__ import annotations

import difflib

from bubblesim.messages.names import did_you_mean

PAUSE_HOOKS = ("sysCall_suspend", "sysCall_suspended", "sysCall_resume")
SUBSTEP_HOOKS = ("sysCall_dyn", "sysCall_joint", "sysCall_contact")
WHEN_CALLED = {
    "sysCall_init": "Called once, in the first step, before all others.",
    "sysCall_thread": "Runs concurrently with the other callbacks, in turns with them.",
    "sysCall_actuation": "Called in each step, before the physics.",
    "sysCall_sensing": "Called in each step, after the physics and the sensors.",
    "sysCall_reset": "Called after the world was reset while time goes on. Not in CoppeliaSim.",
    "sysCall_cleanup": "Called once, at the end.",
    "sysCall_vision": "Called in each step before sysCall_sensing, for the script of a camera.",
    "sysCall_trigger": "Called before sysCall_sensing, when the sensor of the script detects something. "
    "In CoppeliaSim, also for force sensors that break.",
    "sysCall_beforeSimulation": "Called after sysCall_init of this script, before all other scripts.",
    "sysCall_afterSimulation": "Called after sysCall_cleanup of all other scripts.",
    "sysCall_msg": "Called with a message and its origin when a script calls sim.broadcastMsg.",
    "sysCall_dyn": "Called before and after each substep of the physics, with its data.",
    "sysCall_joint": "Called in each substep of the physics for a joint in callback mode; it returns vel and force. In "
    "CoppeliaSim, also for kinematic joints.",
    "sysCall_contact": "Called in each substep of the physics for two shapes that touch; returns if they collide.",
    "sysCall_suspend": "Called at the beginning of a pause.",
    "sysCall_suspended": "Called repeatedly during a pause.",
    "sysCall_resume": "Called at the end of a pause.",
}
HOOKS = tuple(WHEN_CALLED)
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
