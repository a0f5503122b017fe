# SPDX-License-Identifier: BSD-3-Clause
"""Signals to the process group of a program that was started in a group of its own."""

from __future__ import annotations

import os
from pathlib import Path
from signal import Signals
from subprocess import Popen
from typing import Any


def signal_group(program: Popen[Any], number: Signals | int) -> None:
    """Send a signal to a program and all that it has started; 0 only asks if one of them is left.

    The kernel gives the number of a program that was waited for to another process once its group is empty: that
    process gets no signal.

    :raises ProcessLookupError: if none is left.
    """
    if program.returncode is not None and Path(f"/proc/{program.pid}").exists():
        raise ProcessLookupError(f"{program.pid} is another process now")
    os.killpg(program.pid, number)
