# SPDX-License-Identifier: BSD-3-Clause
"""xacro ends together with the program that started it."""

import signal
import subprocess
from pathlib import Path

import pytest

from node_support import clean_environment
from ros_support import built, wait_until


def processes_of(file: Path) -> list[int]:
    """Return the processes with the file on their command line, except the simulator."""
    found = []
    for folder in Path("/proc").glob("[0-9]*"):
        try:
            words = (folder / "cmdline").read_bytes().split(b"\0")
        except OSError:
            continue
        if str(file).encode() in words and not any(word.endswith(b"/sim") for word in words):
            found.append(int(folder.name))
    return found


@pytest.mark.parametrize("number", [signal.SIGTERM, signal.SIGKILL])
def test_xacro_that_does_not_end_does_not_outlive_the_simulator(tmp_path: Path, number: signal.Signals) -> None:
    endless = tmp_path / "endless.xacro"
    endless.write_text("<robot name='r'><link name='${10**10**10}'/></robot>")
    with subprocess.Popen([built("sim"), "--no-ros", endless], env=clean_environment()) as simulator:
        try:
            wait_until(lambda: len(processes_of(endless)) > 0, "xacro to start")
        finally:
            simulator.send_signal(number)
    assert simulator.returncode == -number
    wait_until(lambda: processes_of(endless) == [], "xacro to end")
