# SPDX-License-Identifier: BSD-3-Clause
"""The signals that the simulator handles itself: handlers that scripts set, or rospy for them, are ignored."""

from __future__ import annotations

import signal
import sys
from typing import Any

from bubblesim.program.output import write_line

_ENDING = (signal.SIGINT, signal.SIGTERM, signal.SIGHUP)

_set = signal.signal
_kept: frozenset[int] = frozenset()
_warned = False


def install(*others: int) -> None:
    """Ignore handlers for the signals that end the simulator, and for others of its own, from now on.

    Python would replace the simulator's own handler by such a one, and Ctrl-C would no longer end the simulator.
    """
    global _kept
    _kept = frozenset((*_ENDING, *others))
    signal.signal = _set_unless_kept


def _set_unless_kept(signalnum: int, handler: Any) -> Any:
    if signalnum not in _kept:
        return _set(signalnum, handler)
    _warn(signalnum, handler)
    return signal.getsignal(signalnum)


def _warn(number: int, handler: Any) -> None:
    global _warned
    if _warned:
        return
    _warned = True
    name = signal.Signals(number).name if number in set(signal.Signals) else f"signal {number}"
    owner = getattr(handler, "__module__", None) or "a script"
    write_line(
        sys.stderr,
        f"warning: the handler of {name} that {owner} sets is ignored, because the simulator handles this signal "
        "itself, so that Ctrl-C ends it: define sysCall_cleanup for what shall happen then. "
        "rospy.init_node(..., disable_signals=True) sets none",
    )
