# SPDX-License-Identifier: BSD-3-Clause
"""Ports of the window that are in use, and a window without a simulator."""

import os
import socket
from pathlib import Path

from cli_support import bubblesim
from page_client import Server
from ros_support import free_port
from web_support import Node

PYTHON = Path(f"/proc/{os.getpid()}/comm").read_text().strip()


def test_the_window_of_a_node_takes_the_next_port_and_reports_it(tmp_path: Path) -> None:
    with socket.create_server(("127.0.0.1", 0)) as busy:
        port = busy.getsockname()[1]
        with Node(tmp_path, "ball", f"--web={port}") as node:
            taken = int(node.origin.rpartition(":")[2])
            assert port < taken < port + 20
            line = f"warning: port {port} is in use ({PYTHON}, process {os.getpid()}): the window takes {taken}"
            assert node.find(f"({line.replace('(', '[(]').replace(')', '[)]')})") == line


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
