# SPDX-License-Identifier: BSD-3-Clause
"""Ports of the window that are in use, and a window without a simulator."""

import os
import re
import socket
from pathlib import Path

from cli_support import bubblesim
from page_client import Server
from ros_support import built, free_port, start, stop, wait_until
from web_support import TIMEOUT

PYTHON = Path(f"/proc/{os.getpid()}/comm").read_text().strip()


def test_the_window_of_a_node_takes_the_next_port_and_reports_it(tmp_path: Path) -> None:
    log = tmp_path / "log"
    with socket.create_server(("127.0.0.1", 0)) as busy, log.open("w") as errors:
        port = busy.getsockname()[1]
        node = start([str(built("sim")), "ball", "--no-ros", f"--web={port}"], dict(os.environ), stderr=errors)
        try:
            wait_until(lambda: "the window is at" in log.read_text(), "the window", TIMEOUT / 1000)
            warning, address = log.read_text().splitlines()
        finally:
            stop(node)
    found = re.match(r"info: the window is at http://127.0.0.1:(\d+)/", address)
    assert found
    taken = int(found[1])
    assert port < taken < port + 20
    assert warning == f"warning: port {port} is in use ({PYTHON}, process {os.getpid()}): the window takes {taken}"


def test_a_port_for_view_that_is_in_use_is_an_error_that_names_its_user() -> None:
    with socket.create_server(("127.0.0.1", 0)) as busy:
        port = busy.getsockname()[1]
        run = bubblesim("view", "--port", port, "--remote", free_port())
    assert run.returncode == 1
    assert run.stderr.splitlines()[-1] == (
        f"error: the window cannot listen on 127.0.0.1:{port}: Address already in use "
        f"({PYTHON}, process {os.getpid()}); another port: --port PORT"
    )


def test_a_window_without_a_simulator_names_the_command_that_starts_one(tmp_path: Path) -> None:
    with Server(tmp_path) as server:
        assert server.output.splitlines()[0] == (
            f"warning: no simulator listens on port {server.remote_port}: the window waits for one; to start one: "
            f"bubblesim run SCENE --remote={server.remote_port}"
        )
