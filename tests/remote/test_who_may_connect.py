# SPDX-License-Identifier: BSD-3-Clause
"""Who reaches the simulator from outside: the owner alone by the window, and with a token by --remote."""

import os
import re
import stat
import subprocess
import textwrap
from pathlib import Path

import cbor2
import pytest

import bubblesim
from node_support import Node, run_sim
from process_support import listening_ports
from remote_support import RemoteNode, refusal
from ros_support import free_port, ros_environment

WANTS = "this node wants a token"


@pytest.fixture
def guarded(tmp_path: Path) -> RemoteNode:
    with RemoteNode(tmp_path, "--remote-token", tmp_path / "token") as node:
        yield node


@pytest.mark.parametrize("edit", ["true", "false"])
def test_the_window_opens_no_port_of_the_node(tmp_path: Path, edit: str, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("XDG_RUNTIME_DIR", str(tmp_path))
    environment = ros_environment(free_port(), tmp_path) | {"XDG_RUNTIME_DIR": str(tmp_path)}
    with Node(environment, tmp_path / "log", "ball", "--no-ros", "--web", f"--web-edit={edit}") as node:
        node.wait_for_output("the window is at")
        assert listening_ports(node.process.pid) == []
        (folder,) = tmp_path.glob("bubblesim-*")
        assert stat.S_IMODE(folder.stat().st_mode) == 0o700
        assert node.end() == 0
    assert not folder.exists()


def test_a_window_that_may_only_look_is_not_joined_by_an_open_port() -> None:
    run = run_sim("ball", "--no-ros", "--web", "--web-edit=false", "--remote")
    assert run.returncode == 2
    assert "with --remote it needs --remote-token" in run.stderr


def test_a_token_lets_clients_in(guarded: RemoteNode, tmp_path: Path) -> None:
    token = tmp_path / "token"
    assert stat.S_IMODE(token.stat().st_mode) == 0o600
    with bubblesim.connect(guarded.port, token=token) as simulator:
        assert simulator.sim.getSimulationTime() == 0
    client = guarded.client()
    client.call("bubblesim.token", [token.read_text().strip()])
    assert client.require("sim").getSimulationTime() == 0


def test_without_the_token_no_function_is_called(guarded: RemoteNode, tmp_path: Path) -> None:
    assert WANTS in refusal(bubblesim.connect, guarded.port)
    client = guarded.client()
    assert WANTS in refusal(client.require, "sim")
    assert WANTS in refusal(client.call, "bubblesim.token", ["guess" * 6])
    assert WANTS in refusal(client.call, "sim.startSimulation", [])
    other = tmp_path / "other"
    other.write_text("t" * 32)
    other.chmod(0o600)
    assert WANTS in refusal(lambda: bubblesim.connect(guarded.port, token=other))
    with bubblesim.connect(guarded.port, token=tmp_path / "token") as simulator:
        assert simulator.sim.getSimulationState() == simulator.sim.simulation_stopped


def test_a_known_uuid_does_not_replace_the_token(guarded: RemoteNode, tmp_path: Path) -> None:
    socket = guarded.raw()
    token = (tmp_path / "token").read_text().strip()
    for extra, answer in (({"token": token}, "ret"), ({}, "ret")):  # a line that has sent it keeps it
        socket.send(cbor2.dumps({"func": "sim.getSimulationTime", "args": [], "uuid": "one", **extra}))
        assert answer in cbor2.loads(socket.recv())
    socket.close()
    other = guarded.raw()
    other.send(cbor2.dumps({"func": "sim.getSimulationTime", "args": [], "uuid": "one"}))
    assert WANTS in cbor2.loads(other.recv())["err"]
    other.close()


@pytest.mark.parametrize(
    ("text", "mode", "why"),
    [("short", 0o600, "has 5 characters"), ("t" * 32, 0o644, "other users can read or write")],
)
def test_a_token_that_does_not_protect_is_refused(tmp_path: Path, text: str, mode: int, why: str) -> None:
    token = tmp_path / "token"
    token.write_text(text)
    token.chmod(mode)
    run = run_sim("ball", "--no-ros", f"--remote={free_port()}", f"--remote-token={token}")
    assert run.returncode == 2
    assert why in run.stderr


def test_an_open_port_is_reported_with_who_may_connect(node: RemoteNode) -> None:
    assert "so can all users of this machine; --remote-token=FILE refuses them" in node.output


def test_a_client_cannot_start_the_simulator(node: RemoteNode) -> None:
    sim = node.sim()
    for program in ("sim", "bubblesim", "/usr/lib/rosbag/record"):
        assert re.search("remote client 1 must not start /", refusal(sim.launchExecutable, program, "ball"))


@pytest.mark.skipif(os.geteuid() != 0, reason="only root can be another user")
def test_another_user_reaches_the_open_port_and_nothing_else(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    for folder in (tmp_path, *tmp_path.parents):
        if folder.stat().st_uid == os.geteuid() and folder != Path("/"):
            folder.chmod(folder.stat().st_mode | 0o755)  # so that only the node's own modes protect
    monkeypatch.setenv("XDG_RUNTIME_DIR", str(tmp_path))
    token = tmp_path / "token"
    options = ("--web", f"--remote-token={token}")
    environment = ros_environment(free_port(), tmp_path) | {"XDG_RUNTIME_DIR": str(tmp_path)}
    port = free_port()
    with Node(environment, tmp_path / "log", "ball", "--no-ros", f"--remote={port}", *options) as node:
        node.wait_for_output("the window is at")
        node.wait_for_output("remote clients can connect")
        sockets = [path for path in tmp_path.rglob("*") if stat.S_ISSOCK(path.stat().st_mode)]
        pages = list(tmp_path.glob("bubblesim/*.html"))
        assert sockets
        assert pages
        code = """
            import socket, sys
            for kind, *places in (line.split() for line in sys.stdin):
                for place in places:
                    try:
                        if kind == 'socket':
                            socket.socket(socket.AF_UNIX).connect(place)
                        elif kind == 'port':
                            socket.create_connection(('127.0.0.1', int(place)))
                        else:
                            open(place).close()
                        print(kind)
                    except PermissionError:
                        pass
        """
        places = [("socket", *sockets), ("file", token, *pages), ("port", port)]
        lines = "".join(" ".join(map(str, line)) + "\n" for line in places)
        run = subprocess.run(
            ["/usr/bin/python3", "-c", textwrap.dedent(code)],
            input=lines, user=65534, group=65534, extra_groups=[], capture_output=True, text=True, check=True,
        )  # fmt: skip
        assert run.stdout == "port\n"
        assert WANTS in refusal(bubblesim.connect, port)
