# SPDX-License-Identifier: BSD-3-Clause
"""bubblesim shell, in a terminal of its own."""

import os
import pty
import re
import select
import signal
import subprocess
import time
from collections.abc import Iterator
from pathlib import Path

import pytest

from ros_support import DEADLINE, built, wait_until


class Terminal:
    """The program in a pseudo-terminal."""

    def __init__(self, home: Path, *arguments: object) -> None:
        self._master, slave = pty.openpty()
        environment = {**os.environ, "XDG_STATE_HOME": str(home), "TERM": "dumb"}
        self.process = subprocess.Popen(
            [str(built("bubblesim")), "shell", *map(str, arguments)],
            stdin=slave,
            stdout=slave,
            stderr=slave,
            env=environment,
            start_new_session=True,
            preexec_fn=lambda: os.close(os.open(os.ttyname(0), os.O_RDWR)),  # its controlling terminal
        )
        os.close(slave)
        self.text = ""

    def wait_for(self, pattern: str) -> str:
        """Return the output up to a pattern, and forget it."""
        deadline = time.monotonic() + 3 * DEADLINE
        while not (found := re.search(pattern, self.text)):
            assert time.monotonic() < deadline, self.text
            if not select.select([self._master], [], [], 0.1)[0]:
                continue
            try:
                self.text += os.read(self._master, 4096).decode()
            except OSError:  # closed
                pytest.fail(f"ended: {self.text}")
        before, self.text = self.text[: found.end()], self.text[found.end() :]
        return before

    def wait_until_asleep(self) -> None:
        """Return when its main thread waits for a key or an answer. At a prompt that it has just printed it does not
        wait yet, and would notice a signal at the next key only."""
        wait_until(lambda: state_of(self.process.pid) == "S", "the shell to wait", 3 * DEADLINE)

    def wait_until_node_has_ended(self) -> None:
        children = Path(f"/proc/{self.process.pid}/task/{self.process.pid}/children")
        wait_until(lambda: all(map(has_ended, children.read_text().split())), "the end of the node")

    def type(self, text: str) -> None:
        os.write(self._master, text.encode())

    def close(self) -> None:
        self.process.kill()
        self.process.wait()
        os.close(self._master)


def state_of(pid: int | str) -> str:
    """Return the state of the main thread of a process as in `ps`."""
    return Path(f"/proc/{pid}/stat").read_text().rpartition(")")[2].split()[0]


def has_ended(pid: str) -> bool:
    """Return whether a process only waits to be reaped; its other threads may end after the main thread."""
    try:
        return state_of(pid) == "Z" and len(list(Path(f"/proc/{pid}/task").iterdir())) == 1
    except OSError:  # reaped
        return True


@pytest.fixture
def shell(tmp_path: Path) -> Iterator[Terminal]:
    terminal = Terminal(tmp_path, "tricycle", "--no-ros")
    terminal.wait_for("Ctrl-D ends[^>]*>>> ")
    yield terminal
    terminal.close()


def test_sim_is_there_with_completion_and_short_errors(shell: Terminal, tmp_path: Path) -> None:
    shell.type("sim.getObjectPosi\tsim.getObject('/Tricycle'))\n")
    assert "array([" in shell.wait_for(r"array\(.*\n.*>>> ")
    shell.type("sim.getObject('/Tricyle')\n")
    text = shell.wait_for("RuntimeError: .*\n.*>>> ")
    assert "did you mean /Tricycle?" in text
    assert "Traceback" not in text
    shell.type("\x04")
    assert shell.process.wait(DEADLINE) == 0
    assert "Tricyle" in (tmp_path / "bubblesim" / "shell_history").read_text()


def test_ctrl_c_ends_a_call_and_nothing_else(shell: Terminal) -> None:
    shell.type("sim.setStepping(True); sim.startSimulation(); sim.step()\n")
    shell.wait_for("step[^>]*>>> ")
    shell.type("print('wai' 'ts'); sim.wait(1000)\n")
    shell.wait_for("waits\r?\n")
    shell.wait_until_asleep()
    shell.type("\x03")
    shell.wait_for("KeyboardInterrupt[^>]*>>> ")
    shell.type("print('level', sim.setStepping(True))\n")
    shell.wait_for("level 1[^>]*>>> ")
    shell.wait_until_asleep()
    os.kill(shell.process.pid, signal.SIGINT)
    shell.wait_for("KeyboardInterrupt[^>]*>>> ")
    shell.type("sim.quitSimulator()\n")
    shell.wait_until_node_has_ended()
    shell.type("\n\n")
    shell.wait_for("the simulator has ended")
    assert shell.process.wait(DEADLINE) == 0


def test_a_shell_needs_a_node(tmp_path: Path) -> None:
    terminal = Terminal(tmp_path, "--port", "1")
    terminal.wait_for("no answer from 127.0.0.1:1 .*start it with --remote=1")
    assert terminal.process.wait(DEADLINE) == 1
    terminal.close()
