# SPDX-License-Identifier: BSD-3-Clause
"""Keeps a node busy for hours, and reports what grows.

One node simulates the tricycle for ROS 1 and ROS 2, with a window and remote clients. In each round programs, pages,
subscribers, models and resets come and go there, and one more scene runs beside it from its start to its end. The exit
code is 1 if the node or a scene fails, or if memory, open files or threads of the node grow.
"""

from __future__ import annotations

import argparse
import asyncio
import itertools
import os
import signal
import sys
import tempfile
import time
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from coppeliasim_zmqremoteapi_client import RemoteAPIClient

from node_support import Node, run_sim
from page_client import page_client
from process_support import open_files, status
from ros2_peer import LIBRARY, PEERS, Domain, Ros2Peer
from ros_peer import Peer
from ros_support import REPOSITORY, RosCore, free_port, wait_until
from web_support import TOKEN

_GROWTH = 10.0  # MB an hour that the node may grow: a queue or log that nobody empties grows faster
_MORE_THREADS = 2  # that may be left at the end: a connection may just close
_MORE_FILES = 5  # likewise, and each of rosmaster's three threads keeps a connection once it had something to report
_LONGEST_END = 5.0  # s, of a node that may still load Python, on a busy machine


class SoakError(Exception):
    """What ended or answered as it should not."""


@dataclass(frozen=True)
class Sample:
    """What the node has at the end of a round."""

    hours: float
    memory: float  # MB in RAM
    files: int  # open
    threads: int


class Subject:
    """The node that lives through all rounds, and where its clients find it."""

    def __init__(self, folder: Path, core: RosCore) -> None:
        """Start it, for ROS 2 as well if that is built."""
        self.folder, self.core = folder, core
        self.domain = Domain() if LIBRARY.exists() else None  # of this process, until it ends
        self.remote, self.web = free_port(), free_port()
        options = []
        if self.domain is not None:
            core.env["ROS_DOMAIN_ID"] = str(self.domain.number)
            options.append("--ros=both")
        self.node = Node(
            core.env | TOKEN, folder / "node.txt", "tricycle", *options, f"--remote={self.remote}", f"--web={self.web}"
        )
        wait_until(lambda: "the window is at" in self.node.output, "the window of the node")
        self.start = time.monotonic()

    def sample(self) -> Sample:
        """Measure it."""
        pid = self.node.process.pid
        try:
            memory, files, threads = status(pid, "VmRSS") / 1e3, open_files(pid), status(pid, "Threads")
        except (OSError, StopIteration):
            raise SoakError(f"the node has ended:\n{self.node.output[-3000:]}") from None
        return Sample((time.monotonic() - self.start) / 3600.0, memory, files, threads)


def call_from_outside(subject: Subject) -> None:
    """Let a program move the tricycle, add and remove a model, and reset the simulation."""
    client = RemoteAPIClient(port=subject.remote)
    sim: Any = client.require("sim")
    motor = sim.getObject("/FrontMotor")
    for number in range(50):
        sim.setJointTargetVelocity(motor, number % 5)
        sim.getObjectPose(motor)
    sim.removeModel(sim.loadModel("chair"))
    sim.stopSimulation()
    sim.startSimulation()
    client.socket.close(linger=0)


def look(subject: Subject) -> None:
    """Let a page connect, call a function, and leave."""

    async def visit() -> None:
        async with page_client(f"http://127.0.0.1:{subject.web}") as page:
            await page.wait_for_event("scene")
            await page.call("sim.getSimulationTime")

    asyncio.run(visit())


def subscribe(subject: Subject) -> None:
    """Let a node of rospy receive and publish."""
    with Peer(subject.core, subject.folder / "peer.txt") as peer:
        peer.next("/clock", "rosgraph_msgs/Clock", count=5)
        peer.publish("/steering", "std_msgs/Float32", {"data": 0.1})


def subscribe_in_ros2(subject: Subject) -> None:
    """Let a node of rclpy receive."""
    if subject.domain is None or not (PEERS / "bin" / "python").exists():
        return
    with Ros2Peer(subject.domain, subject.folder / "peer2.txt") as peer:
        peer.received("/clock", "rosgraph_msgs/msg/Clock")
        wait_until(lambda: len(peer.received("/clock")) > 5, "/clock in ROS 2")


GUESTS: Sequence[Callable[[Subject], None]] = (call_from_outside, look, subscribe, subscribe_in_ros2)


def run_beside(scene: str, folder: Path) -> None:
    """Run a scene without ROS to its end, and once more until Ctrl-C."""
    run = run_sim(scene, "--no-ros", "--until", "3", timeout=120)
    if run.returncode != 0:
        raise SoakError(f"{scene} ended with exit code {run.returncode}:\n{run.stderr[-3000:]}")
    with Node(dict(os.environ), folder / "beside.txt", scene, "--no-ros", "--web") as node:
        node.wait_for_output("the window is at")
        begin = time.monotonic()
        code = node.end(signal.SIGINT)
        took = time.monotonic() - begin
    if code != 0 or took > _LONGEST_END:
        raise SoakError(f"{scene} ended with exit code {code} in {took:.1f} s on Ctrl-C:\n{node.output[-3000:]}")


def growth(samples: Sequence[Sample]) -> float:
    """Return how fast the memory grows in the second half, MB an hour: the slope of the line of least squares."""
    half = samples[len(samples) // 2 :]
    if len(half) < 2:
        return 0.0
    return float(np.polyfit([sample.hours for sample in half], [sample.memory for sample in half], 1)[0])


def judge(samples: Sequence[Sample]) -> list[str]:
    """Return what grew too much. The first round is not counted: what it loads stays."""
    findings = []
    first, last = samples[1] if len(samples) > 1 else samples[0], samples[-1]
    if last.files > first.files + _MORE_FILES:
        findings.append(f"{last.files - first.files} more open files")
    if last.threads > first.threads + _MORE_THREADS:
        findings.append(f"{last.threads - first.threads} more threads")
    if last.hours > 0.5 and (rate := growth(samples)) > _GROWTH:  # before, the allocator's own habits decide
        findings.append(f"memory grows by {rate:.1f} MB an hour")
    return findings


def soak(hours: float, folder: Path) -> list[Sample]:
    """Run rounds until the time is over, one at least; print and return the samples."""
    scenes = sorted(file.stem for file in (REPOSITORY / "scenes").glob("*.sdf"))
    samples = []
    with RosCore(folder / "roslog") as core:
        subject = Subject(folder, core)
        with subject.node:
            print("   hours  memory MB  files  threads  scene beside")
            for scene in itertools.cycle(scenes):
                for guest in GUESTS:
                    guest(subject)
                run_beside(scene, folder)
                samples.append(sample := subject.sample())
                print(f"{sample.hours:8.3f} {sample.memory:10.1f} {sample.files:6} {sample.threads:8}  {scene}")
                if sample.hours >= hours:
                    break
            if (code := subject.node.end()) != 0:
                raise SoakError(f"the node ended with exit code {code}:\n{subject.node.output[-3000:]}")
    return samples


def main() -> int:
    """Run the soak of the command line."""
    parser = argparse.ArgumentParser(
        prog="scripts/soak", description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("--hours", type=float, default=8.0, help="how long (default 8); 0 is one round")
    options = parser.parse_args()
    with tempfile.TemporaryDirectory(prefix="bubblesim-soak-") as folder:
        try:
            samples = soak(options.hours, Path(folder))
        except (SoakError, pytest.fail.Exception) as failure:
            print(f"error: {failure}", file=sys.stderr)
            return 1
    findings = judge(samples)
    print(f"rounds: {len(samples)} in {samples[-1].hours:.2f} h, {growth(samples):+.2f} MB an hour")
    for finding in findings:
        print(f"error: {finding}", file=sys.stderr)
    return 1 if findings else 0


if __name__ == "__main__":
    sys.exit(main())
