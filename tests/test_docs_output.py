# SPDX-License-Identifier: BSD-3-Clause
"""The output shown in the documentation equals the real output.

In a console block, the lines below a command, up to the next one, are its output. Other blocks of output follow a
comment, <!-- output of: COMMAND -->. `...` stands for any text in a line, a line `...` for any lines. Files are made
from the code block after <!-- file: NAME -->, or from the text below the first line of that comment. A command that
must run at the same time: <!-- beside: COMMAND -->; the shown command is repeated until that one is ready. <!-- in a
terminal --> lets the command read keys. /home/me is the reader's folder.
"""

import os
import pty
import re
import select
import shlex
import signal
import subprocess
import sys
import time
from collections.abc import Iterator
from dataclasses import dataclass, field
from pathlib import Path

import pytest

from node_support import without_slowness
from ros_support import DEADLINE, REPOSITORY, RosCore, free_port, ros_environment, start, stop

PAGES = sorted([*REPOSITORY.glob("*.md"), *(REPOSITORY / "docs").rglob("*.md")])
PART = re.compile(r"^<!-- (?P<comment>.*?)-->$|^```(?P<language>\w*)\n(?P<code>.*?)^```$", re.MULTILINE | re.DOTALL)
COMMAND = re.compile(r"^\$ ((?:.*\\\n)*.*)\n", re.MULTILINE)
HOME = "/home/me"
MASTER = "http://localhost:11311"
LATE_MASTER = re.compile(r"^plugin 'ROSInterface': load failed .* as soon as a master appears\n", re.MULTILINE)


@dataclass
class Shown:
    """A command of a page and its output on the page."""

    page: Path
    line: int
    command: str
    output: str
    files: dict[str, str]
    beside: list[str] = field(default_factory=list)
    in_terminal: bool = False

    def __str__(self) -> str:
        return f"{self.page.relative_to(REPOSITORY)}:{self.line}"


def shown_on(page: Path) -> Iterator[Shown]:
    """Yield the commands of a page that have output."""
    text = page.read_text()
    files: dict[str, str] = {}
    notes: dict[str, list[str]] = {}
    for part in PART.finditer(text):
        if part["comment"] is not None:
            kind, _, value = part["comment"].partition(":")
            name, _, content = value.strip().partition("\n")
            if kind == "file" and content:
                files[name] = content
            else:
                notes.setdefault(kind.strip(), []).append(value.strip())
            continue
        for name in notes.get("file", []):
            files[name] = part["code"]
        commands = COMMAND.split(part["code"]) if part["language"] == "console" else [""]
        pairs = list(zip(commands[1::2], commands[2::2], strict=True)) if commands[0] == "" else []
        pairs += [(command, part["code"]) for command in notes.get("output of", [])]
        for command, output in pairs:
            if output:
                line = text.count("\n", 0, part.start()) + 1
                beside = notes.get("beside", [])
                yield Shown(page, line, command, output, dict(files), beside, "in a terminal" in notes)
        notes = {}


SHOWN = [shown for page in PAGES for shown in shown_on(page)]


def pattern(output: str) -> re.Pattern[str]:
    """Return the pattern of the real output for the output on the page."""
    lines = output.rstrip("\n").split("\n")
    anything = [
        r"(?:.*\n)*" if line == "..." else ".*".join(map(re.escape, line.split("..."))) + r"\n" for line in lines
    ]
    return re.compile("".join(anything))


def run(shown: Shown, folder: Path, env: dict[str, str]) -> str:
    """Run a command until it ends or, with Ctrl-C, some time after the expected output; return its output."""
    read, write = pty.openpty() if shown.in_terminal else os.pipe()
    keys = write if shown.in_terminal else subprocess.DEVNULL
    process = start(["bash", "-c", shown.command], env, cwd=folder, stdin=keys, stdout=write, stderr=write)
    os.close(write)
    printed, end = "", time.monotonic() + 3 * DEADLINE
    try:
        while time.monotonic() < end:
            if not select.select([read], [], [], 0.5)[0]:
                continue
            try:
                piece = os.read(read, 1 << 16)
            except OSError:  # the terminal was closed
                break
            if not piece:
                break
            printed += piece.decode().replace("\r\n", "\n")
            if pattern(shown.output).match(as_shown(printed, folder, env)):
                end = min(end, time.monotonic() + 3.0)
        return printed
    finally:
        process.send_signal(signal.SIGINT)
        stop(process, 2 * DEADLINE)  # a roscore that it started takes up to 15 s, and would outlive it
        os.close(read)


def as_shown(printed: str, folder: Path, env: dict[str, str]) -> str:
    """Replace the test's folder and master in the output by the reader's, and leave out what a busy machine adds."""
    printed = LATE_MASTER.sub("", without_slowness(printed))
    return printed.replace(str(folder), HOME).replace(env["ROS_MASTER_URI"], MASTER)


def test_there_are_blocks_with_output() -> None:
    assert len(SHOWN) >= 8


@pytest.mark.parametrize("shown", SHOWN, ids=str)
def test_output_is_what_the_page_shows(shown: Shown, tmp_path: Path) -> None:
    folder = tmp_path / "me"
    for name, text in shown.files.items():
        (folder / name).parent.mkdir(parents=True, exist_ok=True)
        (folder / name).write_text(text)
    folder.mkdir(exist_ok=True)
    alone = "--roscore" in shown.command
    core = None if alone else RosCore(tmp_path / "roslog")
    env = ros_environment(free_port(), tmp_path / "roslog") if core is None else core.env
    env = env | {"BUBBLESIM": str(REPOSITORY), "PYTHON": sys.executable}
    beside = [start(shlex.split(command), env, cwd=folder, stdout=subprocess.DEVNULL) for command in shown.beside]
    end = time.monotonic() + DEADLINE

    def is_shown(printed: str) -> bool:
        return pattern(shown.output).fullmatch(as_shown(printed, folder, env)) is not None

    try:
        printed = run(shown, folder, env)
        while not is_shown(printed) and (beside or LATE_MASTER.search(printed)) and time.monotonic() < end:
            printed = run(shown, folder, env)
    finally:
        for process in beside:
            stop(process)
        if core:
            stop(core.process)
    assert is_shown(printed), f"{shown}\n$ {shown.command}\n{as_shown(printed, folder, env)}"
