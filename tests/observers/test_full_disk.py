# SPDX-License-Identifier: BSD-3-Clause
"""A recording on a full disk ends with a readable bag; the simulation continues."""

import resource
import subprocess
from collections.abc import Iterator
from pathlib import Path

import pytest
import rosbag

from node_support import PREFIX, write
from ros_support import RosCore, built

SECONDS = 5.0
SCRIPT = """
    def sysCall_init():
        self.numbers = simROS.advertise('/numbers', 'std_msgs/Float32')
        self.blocks = simROS.advertise('/blocks', 'std_msgs/UInt8MultiArray')
    def sysCall_sensing():
        simROS.publish(self.numbers, {'data': sim.getSimulationTime()})
        simROS.publish(self.blocks, {'data': bytes(100_000)})
    def sysCall_cleanup(): print('until', round(sim.getSimulationTime(), 3))
"""


def record(core: RosCore, folder: Path, bag: Path, limit: int | None = None) -> "subprocess.CompletedProcess[str]":
    """Record a run of 100 steps with 100 kB each, 10 MB; no file may exceed `limit` bytes."""

    def limit_files() -> None:
        if limit:
            resource.setrlimit(resource.RLIMIT_FSIZE, (limit, limit))

    script = write(folder / "script.py", SCRIPT)
    options = ["--until", str(SECONDS), "--speed", "max", "--record", str(bag), "--child-script", f"/Ball={script}"]
    return subprocess.run(
        [str(built("sim")), "ball", *options],
        env=core.env,
        capture_output=True,
        text=True,
        check=False,
        timeout=60,
        preexec_fn=limit_files,
    )


def check(run: "subprocess.CompletedProcess[str]", bag: Path, size: int, reason: str) -> None:
    errors = [line for line in run.stderr.splitlines() if line.startswith("error")]
    assert errors == [f"error: recording stopped: {bag}: {reason}; the file contains the messages before"], run.stderr
    assert (run.returncode, PREFIX.sub("", run.stdout)) == (0, f"until {SECONDS:.3g}.0\n")
    assert bag.stat().st_size <= size
    with rosbag.Bag(str(bag)) as file:
        numbers = [message.data for _, message, _ in file.read_messages(topics=["/numbers"])]
    # All except the chunk in progress, of 768 KiB: one message per 100 kB.
    assert size / 100_000 - 10 < len(numbers) <= size / 100_000
    assert numbers == pytest.approx([0.05 * n for n in range(len(numbers))], abs=1e-5)


@pytest.fixture
def small_disk(tmp_path: Path) -> Iterator[Path]:
    disk = tmp_path / "disk"
    disk.mkdir()
    if subprocess.run(["mount", "-t", "tmpfs", "-o", "size=4m", "none", disk], check=False).returncode:
        pytest.skip("cannot mount a small disk: needs root")
    yield disk
    subprocess.run(["umount", disk], check=True)


def test_on_a_full_disk(roscore: RosCore, tmp_path: Path, small_disk: Path) -> None:
    bag = small_disk / "run.bag"
    check(record(roscore, tmp_path, bag), bag, 4 << 20, "No space left on device")


# The error occurs within a message, at the end of a chunk, and in the index that is written at the end of the run.
@pytest.mark.parametrize("limit", [2_500_000, 2_700_000, 2_707_000, 2_708_000, 3_000_001])
def test_where_files_may_not_grow(roscore: RosCore, tmp_path: Path, limit: int) -> None:
    bag = tmp_path / "run.bag"
    check(record(roscore, tmp_path, bag, limit), bag, limit, "File too large")


def test_when_only_the_index_does_not_fit(roscore: RosCore, tmp_path: Path) -> None:
    roscore.set_param("/use_sim_time", True)  # with wall time, chunks end when the machine gets to it
    whole = tmp_path / "whole.bag"
    assert record(roscore, tmp_path, whole).returncode == 0
    limit = whole.stat().st_size - 1
    bag = tmp_path / "run.bag"
    check(record(roscore, tmp_path, bag, limit), bag, limit, "File too large")


def test_a_bag_that_cannot_be_begun_is_refused_at_the_start(roscore: RosCore, tmp_path: Path) -> None:
    run = record(roscore, tmp_path, Path("/dev/full"))
    assert run.returncode == 2
    assert "No space left on device" in run.stderr
    assert "Traceback" not in run.stderr
