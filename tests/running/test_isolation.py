# SPDX-License-Identifier: BSD-3-Clause
"""The numbers of runs that share a machine."""

import re
import subprocess
import sys

import pytest

from bubblesim.running import isolation
from bubblesim.running.processes import RunError

BECOMES_ANOTHER_PROGRAM = """
import os
from bubblesim.running.isolation import isolate
print(isolate({}), flush=True)
os.execvp("bash", ["bash", "-c", "echo another program; exec sleep 60"])
"""


def test_a_number_is_taken_until_the_program_ends_that_the_process_became(monkeypatch: pytest.MonkeyPatch) -> None:
    command = [sys.executable, "-c", BECOMES_ANOTHER_PROGRAM]
    with subprocess.Popen(command, stdout=subprocess.PIPE, text=True) as process:
        try:
            assert process.stdout is not None
            found = re.search(r"ROS_DOMAIN_ID=(\d+)", process.stdout.readline())
            assert found is not None
            assert process.stdout.readline() == "another program\n"
            number = int(found[1])
            monkeypatch.setattr(isolation, "_numbers", lambda: [number])
            with pytest.raises(RunError, match="are all in use"):
                isolation.reserve_domain()
        finally:
            process.kill()
    again, holder = isolation.reserve_domain()
    holder.close()
    assert again == number
