# SPDX-License-Identifier: BSD-3-Clause
"""A run in which one call of the system fails, anywhere, ends with an error or goes on; no file is half written."""

import errno
import os
import subprocess
from dataclasses import dataclass
from pathlib import Path

import pytest
import rosbag

from node_support import write
from ros_support import DEADLINE, RosCore, built

ERRORS = {"open": errno.EMFILE, "read": errno.EIO, "write": errno.ENOSPC}
SECONDS = 1.0
MESSAGES = 20
SCRIPT = """
    def sysCall_init(): self.numbers = simROS.advertise('/numbers', 'std_msgs/Float32')
    def sysCall_sensing(): simROS.publish(self.numbers, {'data': sim.getSimulationTime()})
"""


@dataclass(frozen=True)
class Run:
    """What a run of the node has left in its folder."""

    folder: Path
    code: int
    errors: str
    calls: int
    """How many of the kind that may fail."""

    @property
    def state(self) -> bytes | None:
        file = self.folder / "state"
        return file.read_bytes() if file.exists() else None

    def recorded(self) -> list[float]:
        """Return the numbers in the bag, if there is one."""
        numbers: list[float] = []
        for file in self.folder.glob("run.bag*"):
            with rosbag.Bag(str(file)) as bag:
                numbers += [message.data for _, message, _ in bag.read_messages(topics=["/numbers"])]
        return numbers


def run_with_failure(core: RosCore, folder: Path, kind: str, number: int) -> Run:
    """Load, step, record and save while the number-th call of a kind fails; 0 for none."""
    folder.mkdir()
    count = folder / "count"
    count.write_bytes(bytes(8))
    script = write(folder / "script.py", SCRIPT)
    env = core.env | {
        "LD_PRELOAD": " ".join(filter(None, (os.environ.get("LD_PRELOAD"), str(built("libfailing_calls.so"))))),
        "FAILING_PROGRAM": "sim",
        "FAILING_CALL": kind,
        "FAILING_NUMBER": str(number),
        "FAILING_ERROR": str(ERRORS[kind]),
        "FAILING_COUNT": str(count),
    }
    outputs = ("--record", folder / "run.bag", "--save-state", folder / "state")
    options = ("--speed", "max", "--until", SECONDS, "--child-script", f"/Ball={script}", *outputs)
    command = [str(built("sim")), "ball", *map(str, options)]
    run = subprocess.run(command, env=env, capture_output=True, text=True, timeout=3 * DEADLINE, check=False)
    return Run(folder, run.returncode, run.stderr, int.from_bytes(count.read_bytes(), "little"))


@pytest.mark.parametrize("kind", ERRORS)
@pytest.mark.parametrize("places", [6, pytest.param(150, marks=pytest.mark.long)])
def test_a_call_that_fails_anywhere_leaves_no_half_written_file(
    roscore: RosCore, tmp_path: Path, kind: str, places: int
) -> None:
    whole = run_with_failure(roscore, tmp_path / "whole", kind, 0)
    assert (whole.code, len(whole.recorded())) == (0, MESSAGES), whole.errors
    for number in sorted({max(1, whole.calls * place // places) for place in range(1, places + 1)}):
        run = run_with_failure(roscore, tmp_path / str(number), kind, number)
        report = f"{kind} {number} of {whole.calls}: exit code {run.code}: {run.errors}"
        assert run.code >= 0, report  # no signal
        assert run.code == 0 or "error" in run.errors.lower(), report
        assert run.state == whole.state or (run.state is None and run.code != 0), report
        assert run.recorded() == whole.recorded()[: len(run.recorded())], report
        assert not list(run.folder.glob("*.part")), report
        assert not list(run.folder.glob("*.active")), report
