# SPDX-License-Identifier: BSD-3-Clause
"""Output to a full or closed stdout is reported as lost."""

import os
import pty
import re
import subprocess
from pathlib import Path

import pytest

from node_support import without_slowness, write
from ros_support import DEADLINE, built

RUN = ["ball", "--no-ros", "--speed", "max", "--until", "0.2"]
FULL, CLOSED, NO_READER = ">/dev/full", ">&-", "to a pipe without a reader"


def shell(program: str, *arguments: str, to: str) -> "subprocess.CompletedProcess[str]":
    """Run a built program with its stdout redirected."""
    reader, writer = os.pipe()
    os.close(reader)
    command = " ".join([str(built(program)), *arguments, "" if to == NO_READER else to])
    try:
        return subprocess.run(
            ["bash", "-c", command], stdout=writer, stderr=subprocess.PIPE, text=True, check=False, timeout=60
        )
    finally:
        os.close(writer)


@pytest.mark.parametrize("to", [FULL, CLOSED, NO_READER])
@pytest.mark.parametrize("arguments", [[*RUN, "--state-hash"], ["--list-scenes"], ["--help"], ["--version"]])
def test_results_of_the_node_that_are_lost_are_a_failure(arguments: list[str], to: str) -> None:
    run = shell("sim", *arguments, to=to)
    assert run.returncode == 1
    assert run.stderr.startswith("error: cannot write to stdout: "), run.stderr
    assert len(run.stderr.splitlines()) == 1


@pytest.mark.parametrize("to", [FULL, CLOSED])
def test_output_of_scripts_that_is_lost_is_a_failure_but_does_not_end_the_script(tmp_path: Path, to: str) -> None:
    code = f"""
        def sysCall_init(): self.n = 0
        def sysCall_sensing():
            print('sensing', flush=True)
            self.n += 1
        def sysCall_cleanup(): open('{tmp_path}/count', 'w').write(str(self.n))
    """
    script = write(tmp_path / "script.py", code)
    run = shell("sim", *RUN, "--child-script", f"/Ball={script}", to=to)
    assert run.returncode == 1
    reported = without_slowness(run.stderr).splitlines()
    assert reported[0].startswith("error: cannot write what scripts print to stdout: ")
    assert len(reported) == 1
    assert (tmp_path / "count").read_text() == "4"


@pytest.mark.parametrize(
    ("program", "arguments"),
    [
        ("bubblesim", ["scenes"]),
        ("bubblesim", ["api"]),
        ("bubblesim", ["--help"]),
        ("bubblesim", ["check", "ball"]),
        ("check", ["ball"]),
        ("messages", []),
        ("robot_description", ["tricycle", "/Tricycle"]),
    ],
)
@pytest.mark.parametrize("to", [FULL, CLOSED])
def test_results_of_the_command_line_that_are_lost_are_a_failure(program: str, arguments: list[str], to: str) -> None:
    run = shell(program, *arguments, to=to)
    assert run.returncode == 1
    assert run.stderr.startswith("error: "), run.stderr
    assert len(run.stderr.splitlines()) == 1


def test_a_closed_stdout_is_no_failure_when_nothing_is_printed(tmp_path: Path) -> None:
    script = write(tmp_path / "script.py", "def sysCall_init(): pass\n")
    run = shell("sim", *RUN, "--child-script", f"/Ball={script}", to=CLOSED)
    assert (run.returncode, without_slowness(run.stderr)) == (0, "")


def test_on_a_terminal_the_run_ends_with_what_was_simulated() -> None:
    text = on_a_terminal([str(built("bubblesim")), "run", "tricycle", *RUN[1:]])
    assert re.search(
        r"^simulated 0\.20 s in \d+\.\d\d s: real-time factor \d+\.\d\d, 4 steps\r?$", text, re.MULTILINE
    ), text


def test_elsewhere_nothing_is_reported_of_what_was_simulated() -> None:
    assert (
        "simulated"
        not in subprocess.run(
            [built("bubblesim"), "run", "tricycle", *RUN[1:]], capture_output=True, text=True, check=True
        ).stderr
    )


def on_a_terminal(command: list[str]) -> str:
    """Return what a program writes to a terminal, stdout and stderr."""
    ours, its = pty.openpty()
    process = subprocess.Popen(command, stdout=its, stderr=its)
    os.close(its)
    text = b""
    while True:
        try:
            text += os.read(ours, 4096)
        except OSError:  # the other end is closed
            break
    os.close(ours)
    assert process.wait(timeout=DEADLINE) == 0
    return text.decode()
