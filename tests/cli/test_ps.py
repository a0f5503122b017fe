# SPDX-License-Identifier: BSD-3-Clause
"""Runs of one user beside each other, their list, and their end."""

import re
import signal
import subprocess
from collections.abc import Iterator
from pathlib import Path

import pytest

from cli_support import bubblesim
from ros_support import DEADLINE, built, ros_environment, start, stop, wait_until


class Run:
    """`bubblesim run ball` with options, in the background."""

    def __init__(self, folder: Path, *options: str, **changes: str) -> None:
        folder.mkdir()
        self._log = folder / "log"
        command = [str(built("bubblesim")), "run", "ball", "--isolated", *options]
        environment = {**ros_environment(0, folder), **changes}
        del environment["ROS_MASTER_URI"]
        with self._log.open("w") as log:
            self.process = start(command, environment, stdout=log, stderr=subprocess.STDOUT)

    @property
    def output(self) -> str:
        return self._log.read_text()

    def find(self, pattern: str) -> str:
        wait_until(lambda: re.search(pattern, self.output) is not None, pattern, 3 * DEADLINE)
        found = re.search(pattern, self.output)
        assert found
        return found[1]


@pytest.fixture
def two(tmp_path: Path) -> Iterator[tuple[Run, Run]]:
    runs = Run(tmp_path / "a", "--web"), Run(tmp_path / "b")
    try:
        yield runs
    finally:
        for run in runs:
            stop(run.process, 2 * DEADLINE)


def listed(run: "subprocess.CompletedProcess[str]") -> list[list[str]]:
    return [re.split(r"\s{2,}", line) for line in run.stdout.splitlines()[1:]]


def test_isolated_runs_have_masters_domains_and_windows_of_their_own(two: tuple[Run, Run]) -> None:
    masters = [run.find(r"load succeeded: node /sim_ros_interface at ROS master (\S+)") for run in two]
    commands = [run.find(r"info: in other terminals: export (.*)") for run in two]
    window = two[0].find(r"the window is at http://127.0.0.1:(\d+)/")
    assert len(set(masters)) == 2
    domains = [int(master.rpartition(":")[2]) - 11400 for master in masters]
    for master, domain, command in zip(masters, domains, commands, strict=True):
        assert 1 <= domain <= 101
        assert command == f"ROS_MASTER_URI={master} ROS_HOSTNAME=localhost ROS_DOMAIN_ID={domain}"
    rows = {row[4]: row for row in listed(bubblesim("ps")) if row[4] in masters}
    assert [rows[master][1] for master in masters] == ["ball", "ball"]
    assert [rows[master][6] for master in masters] == [window, "-"]
    ended = bubblesim("ps", "--stop", rows[masters[1]][0])
    assert (ended.returncode, ended.stdout) == (0, f"{rows[masters[1]][0]} ended\n")
    assert two[1].process.wait(2 * DEADLINE) == 0
    assert two[0].process.poll() is None
    assert masters[1] not in bubblesim("ps").stdout


def test_a_process_that_is_no_simulator_is_not_ended() -> None:
    other = subprocess.Popen(["sleep", "60"])
    try:
        run = bubblesim("ps", "--stop", other.pid)
        assert run.returncode == 2
        assert f"error: --stop: {other.pid} is not a process of a simulator of yours" in run.stderr
        assert other.poll() is None
    finally:
        other.send_signal(signal.SIGKILL)
        other.wait()


def test_remote_clients_of_an_isolated_run_get_a_port_of_their_own(tmp_path: Path) -> None:
    run = Run(tmp_path / "c", "--no-ros", "--remote")
    try:
        assert run.find(r"remote clients can connect to tcp://127.0.0.1:(\d+)") != "23000"
        assert "roscore" not in run.output
    finally:
        stop(run.process)


def test_a_user_who_came_over_ssh_gets_the_command_of_the_tunnel(tmp_path: Path) -> None:
    run = Run(tmp_path / "d", "--no-ros", "--web", SSH_CONNECTION="192.0.2.7 50000 192.0.2.1 22")
    try:
        port = run.find(r"the window is at http://127.0.0.1:(\d+)/")
        tunnel = run.find(r"info: on your own machine, before you open it: (.*)")
        assert re.fullmatch(rf"ssh -L {port}:127.0.0.1:{port} \S+@192.0.2.1", tunnel)
    finally:
        stop(run.process)
