# SPDX-License-Identifier: BSD-3-Clause
"""The end of programs that scripts started."""

from __future__ import annotations

import contextlib
import os
import signal
import subprocess
import time
from collections.abc import Sequence

Program = subprocess.Popen[bytes]

_SECONDS_TO_END = 0.8  # for all of them: the node has little more to end in


def end_programs(programs: Sequence[Program]) -> None:
    """End process groups, each of which may outlive the program that leads it: all politely, then the rest by force."""
    for program in programs:
        _signal(program, signal.SIGTERM)
    deadline = time.monotonic() + _SECONDS_TO_END
    while any(_lives(program) for program in programs) and time.monotonic() < deadline:
        time.sleep(0.01)
    for program in programs:
        _signal(program, signal.SIGKILL)
        program.wait()


def _signal(program: Program, number: signal.Signals) -> None:
    with contextlib.suppress(ProcessLookupError):  # the group is gone
        os.killpg(program.pid, number)


def _lives(program: Program) -> bool:
    program.poll()  # one that has ended counts until somebody asks how
    try:
        os.killpg(program.pid, 0)
    except ProcessLookupError:
        return False
    return True
