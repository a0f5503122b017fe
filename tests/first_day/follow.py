# SPDX-License-Identifier: BSD-3-Clause
"""Follows the pages for newcomers literally, as a person with several terminals would; see scripts/first_day.

Each command of a page is typed in a new terminal, in its order. One that does not end by itself stays open until a
simulator is started, or the page ends. Files that a page wants to be saved are saved.
"""

import os
import re
import signal
import subprocess
import sys
import tempfile
import time
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

REPOSITORY = Path(__file__).resolve().parents[2]
TUTORIALS = ("ball", "tricycle", "first_robot", "tricycle_cmd_vel")
PAGES = ("README.md", *(f"docs/tutorials/{name}.md" for name in TUTORIALS))
BLOCK = re.compile(r"^```(\w+)\n(.*?)^```", re.MULTILINE | re.DOTALL)
SAVED = re.compile(r"[Ss]aved?(?: this| it)? as\s+`([\w.]+)`")
STARTS_A_SIMULATOR = re.compile(r"bubblesim run|roslaunch|rosrun bubblesim sim\b")
DONE_BEFORE = re.compile(r"scripts/|source ")
FAILED = re.compile(r"^(error|Traceback|ERROR|RLException)|\[ERROR\]", re.MULTILINE)
STAYS = 20.0  # s after which a command is one that does not end by itself
ENDING = 25.0  # s; roslaunch waits for its nodes


@dataclass
class Terminal:
    """A command that runs."""

    command: str
    process: "subprocess.Popen[bytes]"
    log: Path

    def close(self) -> None:
        """Press Ctrl-C."""
        if self.process.poll() is None:
            os.killpg(self.process.pid, signal.SIGINT)
            self.process.wait(ENDING)


def commands_of(language: str, code: str) -> Iterator[str]:
    """Yield what is typed: the lines with a prompt, or a whole block of bash."""
    if language == "bash":
        yield code.strip()
    elif language == "console":
        yield from (line[2:] for line in code.splitlines() if line.startswith("$ ") and not DONE_BEFORE.match(line[2:]))


def file_name(page: str, begin: int, end: int) -> str | None:
    """Return as which file the text beside a block wants it to be saved."""
    before, after = SAVED.findall(page[max(0, begin - 300) : begin]), SAVED.findall(page[end : end + 100])
    return next(iter(after[:1] + before[-1:]), None)


def follow(name: str, folder: Path, setup: str) -> list[str]:
    """Follow a page; return what failed."""
    page = (REPOSITORY / name).read_text()
    terminals: list[Terminal] = []
    failures = []
    for block in BLOCK.finditer(page):
        language, code = block.groups()
        saved = file_name(page, block.start(), block.end()) if language in ("python", "xml") else None
        if saved:
            (folder / saved).write_text(code)
        for command in commands_of(language, code):
            if STARTS_A_SIMULATOR.search(command):
                close(terminals)
            begin = time.monotonic()
            terminal = type_in(command, folder, setup)
            terminals.append(terminal)
            failure = watch(terminal)
            seconds = time.monotonic() - begin
            what = failure or ("runs" if terminal.process.poll() is None else "done")
            first_line = command.splitlines()[0]
            print(f"{seconds:6.1f} s  {name}  {first_line}: {what}", flush=True)
            if failure:
                failures.append(f"{name}: {command}\n{terminal.log.read_text(errors='replace')}")
    close(terminals)
    return failures


def type_in(command: str, folder: Path, setup: str) -> Terminal:
    """Open a terminal with a command."""
    log = folder / f"{len(list(folder.glob('*.log')))}.log"
    typed = ["script", "-qefc", f"bash -c '{command}'", "/dev/null"] if "teleop" in command else ["bash", "-c", command]
    line = f'typed=("$@"); set --; {setup}\nexec "${{typed[@]}}"'  # setup.bash reads the arguments of its caller
    with log.open("wb") as output:
        process = subprocess.Popen(
            ["bash", "-c", line, "bash", *typed],
            cwd=folder,
            stdin=subprocess.DEVNULL,
            stdout=output,
            stderr=output,
            start_new_session=True,
        )
    return Terminal(command, process, log)


def watch(terminal: Terminal) -> str:
    """Wait until a command has ended or is one that stays; return what is wrong."""
    try:
        code = terminal.process.wait(STAYS)
    except subprocess.TimeoutExpired:
        code = 0
    if code:
        return f"FAILED with exit code {code}"
    return "FAILED" if FAILED.search(terminal.log.read_text(errors="replace")) else ""


def close(terminals: list[Terminal]) -> None:
    """Close all terminals, the last one first."""
    for terminal in reversed(terminals):
        terminal.close()
    terminals.clear()


def main() -> int:
    """Follow the pages; the argument is what a new terminal needs first, such as 'source .ws/devel/setup.bash'."""
    signal.signal(signal.SIGINT, signal.default_int_handler)  # jobs in the background ignore it
    setup = sys.argv[1] if len(sys.argv) > 1 else ":"
    with tempfile.TemporaryDirectory(prefix="first-day-") as folder:
        failures = [failure for page in PAGES for failure in follow(page, Path(folder), setup)]
    for failure in failures:
        print(f"\n{failure}")
    return int(bool(failures))


if __name__ == "__main__":
    sys.exit(main())
