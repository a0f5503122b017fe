# SPDX-License-Identifier: BSD-3-Clause
"""Signals to the groups of programs reach these programs only."""

import signal
import subprocess
from pathlib import Path

import pytest

from bubblesim.program.groups import signal_group

NEXT = Path("/proc/sys/kernel/ns_last_pid")  # the number that the next process follows


def with_number(number: int) -> "subprocess.Popen[bytes]":
    """Start a process with a number that is free."""
    for _ in range(100):  # others start processes, too
        NEXT.write_text(str(number - 1))
        process = subprocess.Popen(["sleep", "60"], start_new_session=True)
        if process.pid == number:
            return process
        process.kill()
        process.wait()
    pytest.skip("other processes take the number")


def test_a_group_gets_a_signal_after_the_end_of_its_first_process() -> None:
    program = subprocess.Popen(["sh", "-c", "sleep 60 & echo"], stdout=subprocess.PIPE, start_new_session=True)
    assert program.stdout is not None
    program.stdout.readline()
    program.wait()
    signal_group(program, signal.SIGKILL)
    assert program.stdout.read() == b"", "sleep has the pipe until it ends"


def test_a_process_that_has_the_number_of_an_ended_program_gets_no_signal() -> None:
    try:
        NEXT.write_text(NEXT.read_text())
    except OSError as error:
        pytest.skip(f"numbers of processes cannot be chosen: {error}")
    program = subprocess.Popen(["true"], start_new_session=True)
    program.wait()
    other = with_number(program.pid)
    with pytest.raises(ProcessLookupError):
        signal_group(program, signal.SIGTERM)
    assert other.poll() is None
    other.kill()
    assert other.wait() == -signal.SIGKILL, "the signal before did not reach it"
