# SPDX-License-Identifier: BSD-3-Clause
"""Ctrl-C ends programs without a traceback, wherever they wait."""

import os
import pty
import re
import signal
import socket
import subprocess
import time
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

import pytest

from ros_support import DEADLINE, RosCore, built, free_port, ros_environment, start, stop, wait_until

NODES = {
    "cmd_vel_to_tricycle.py": [],
    "explore.py": [],
    "go_to.py": [],
    "joy_teleop.py": [],
    "map_server": ["MAP"],
    "rosBubbleRob": ["/left", "/right", "/nose", "/time"],
    "teleop_twist_keyboard.py": [],
    "tricycle_avoid.py": [],
}
CLIENTS = {
    "add_message": ["--help"],
    "bubblesim": ["doctor"],
    "check": ["tricycle"],
    "messages": [],
    "robot_description": ["tricycle", "/Tricycle"],
    "tricycle_socket_client.py": ["--port", "PORT"],
}


@contextmanager
def running(program: str, arguments: list[str], env: dict[str, str], folder: Path) -> Iterator["subprocess.Popen[str]"]:
    """Run the program with keys from a terminal; its output goes to the file `log`."""
    (folder / "map.pgm").write_bytes(b"P5 2 2 255\n" + bytes([254] * 4))
    (folder / "map.yaml").write_text(
        "image: map.pgm\nresolution: 0.1\norigin: [0, 0, 0]\noccupied_thresh: 0.65\nfree_thresh: 0.2\nnegate: 0\n"
    )
    known = {"MAP": str(folder / "map.yaml"), "PORT": str(free_port())}
    ours, its = pty.openpty()
    with (folder / "log").open("w") as log:
        command = [str(built(program)), *(known.get(argument, argument) for argument in arguments)]
        process = start(command, env, stdin=its, stdout=log, stderr=subprocess.STDOUT)
    os.close(its)
    try:
        yield process
    finally:
        stop(process)
        os.close(ours)


def ends_quietly(process: "subprocess.Popen[str]", log: Path) -> None:
    process.send_signal(signal.SIGINT)
    try:
        code = process.wait(timeout=DEADLINE)
    except subprocess.TimeoutExpired:
        pytest.fail(f"it goes on; it printed:\n{log.read_text()}")
    assert code in (0, 1, 130, -signal.SIGINT)
    assert "Traceback" not in log.read_text()
    assert "Exception" not in log.read_text()


def wait_until_it_loads_modules(process: "subprocess.Popen[str]") -> None:
    """Wait until Python has started and handles SIGINT, before the program's first lines."""

    def catches() -> bool:
        if process.poll() is not None:
            return False
        caught = re.search(r"SigCgt:\s+(\w+)", Path(f"/proc/{process.pid}/status").read_text())
        return caught is not None and bool(int(caught[1], 16) & 1 << (signal.SIGINT - 1))

    deadline = time.monotonic() + 20
    for wanted in (True, False):
        while catches() != wanted and process.poll() is None and time.monotonic() < deadline:
            time.sleep(0.0005)


@pytest.mark.parametrize("delay", [0.0, 0.3, 4.0])
@pytest.mark.parametrize("program", NODES)
def test_of_a_node_without_a_master(tmp_path: Path, program: str, delay: float) -> None:
    env = ros_environment(free_port(), tmp_path)
    with running(program, NODES[program], env, tmp_path) as process:
        wait_until_it_loads_modules(process)
        time.sleep(delay)
        ends_quietly(process, tmp_path / "log")


@pytest.mark.parametrize("program", NODES)
def test_of_a_node_with_a_master(roscore: RosCore, tmp_path: Path, program: str) -> None:
    before = roscore.nodes()
    with running(program, NODES[program], roscore.env, tmp_path) as process:
        wait_until(lambda: roscore.nodes() != before, "the node")
        time.sleep(1.0)
        ends_quietly(process, tmp_path / "log")


@pytest.mark.parametrize("program", ["tricycle_avoid.py", "cmd_vel_to_tricycle.py", "go_to.py"])
def test_of_a_node_whose_master_has_gone(tmp_path: Path, program: str) -> None:
    core = RosCore(tmp_path)
    try:
        before = core.nodes()
        with running(program, NODES[program], core.env, tmp_path) as process:
            wait_until(lambda: core.nodes() != before, "the node")
            time.sleep(1.0)
            core.kill()
            ends_quietly(process, tmp_path / "log")
    finally:
        stop(core.process)


@pytest.mark.parametrize("program", ["tricycle_avoid.py", "go_to.py"])
def test_of_a_node_whose_master_does_not_answer(tmp_path: Path, program: str) -> None:
    with socket.create_server(("127.0.0.1", 0)) as silent:
        env = ros_environment(silent.getsockname()[1], tmp_path)
        with running(program, NODES[program], env, tmp_path) as process:
            silent.settimeout(20)
            silent.accept()
            time.sleep(0.2)
            ends_quietly(process, tmp_path / "log")


@pytest.mark.parametrize("delay", [0.0, 0.1, 0.5])
@pytest.mark.parametrize("program", CLIENTS)
def test_of_a_client(tmp_path: Path, program: str, delay: float) -> None:
    with running(program, CLIENTS[program], ros_environment(free_port(), tmp_path), tmp_path) as process:
        wait_until_it_loads_modules(process)
        time.sleep(delay)
        ends_quietly(process, tmp_path / "log")


def test_the_client_over_tcp_states_at_once_what_it_waits_for(tmp_path: Path) -> None:
    with running(
        "tricycle_socket_client.py", ["--port", "PORT"], ros_environment(free_port(), tmp_path), tmp_path
    ) as process:
        wait_until(lambda: "waiting for the simulation at 127.0.0.1:" in (tmp_path / "log").read_text(), "the line")
        assert process.poll() is None
        ends_quietly(process, tmp_path / "log")
