# SPDX-License-Identifier: BSD-3-Clause
"""Ending programs started by scripts."""

from __future__ import annotations

import contextlib
import signal
import subprocess
import time
from collections.abc import Sequence

from bubblesim.program.groups import signal_group

Program = subprocess.Popen[bytes]

_SECONDS_TO_END = 0.8  # for all programs: the node has little more time to end


def end_programs(programs: Sequence[Program]) -> None:
    """End process groups, which may outlive their leaders: SIGTERM for all, then SIGKILL for the rest."""
    for program in programs:
        _signal(program, signal.SIGTERM)
    deadline = time.monotonic() + _SECONDS_TO_END
    while any(_is_running(program) for program in programs) and time.monotonic() < deadline:
        time.sleep(0.01)
    for program in programs:
        _signal(program, signal.SIGKILL)
        program.wait()


def _signal(program: Program, number: signal.Signals) -> None:
    with contextlib.suppress(ProcessLookupError):  # the group does not exist any more
        signal_group(program, number)


def _is_running(program: Program) -> bool:
    program.poll()  # reap it, otherwise it counts as running
    try:
        signal_group(program, 0)
    except ProcessLookupError:
        return False
    return True
