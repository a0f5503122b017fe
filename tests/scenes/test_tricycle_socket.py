# SPDX-License-Identifier: BSD-3-Clause
"""The tricycle's TCP server: its answers, and that no client can harm it or other clients."""

import contextlib
import os
import re
import signal
import socket
import struct
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path

import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from node_support import Node, without_slowness
from ros_support import DEADLINE, REPOSITORY, free_port, start, stop, wait_until

ANSWER = re.compile(r"\d+\.\d{3};\d+\.\d{2}")
MOST_CLIENTS = 32
PRINT_TARGETS = """
sense = sysCall_sensing
def sysCall_sensing():
    sense()
    print('targets', sim.getJointTargetPosition(self.steering), sim.getJointTargetVelocity(self.motor))
"""


class Client:
    """A client that can send anything."""

    def __init__(self, port: int) -> None:
        self.connection = socket.create_connection(("127.0.0.1", port), timeout=DEADLINE)
        self._reader = self.connection.makefile("rb")

    def send(self, data: bytes) -> None:
        self.connection.sendall(data)

    def line(self) -> str:
        """Return the next line; empty when the connection has been closed."""
        return self._reader.readline().decode().rstrip("\n")

    def ask(self, line: bytes) -> str:
        self.send(line + b"\n")
        return self.line()

    def reset(self) -> None:
        """Reset the connection."""
        self.connection.setsockopt(socket.SOL_SOCKET, socket.SO_LINGER, struct.pack("ii", 1, 0))
        self.close()

    def close(self) -> None:
        self._reader.close()
        self.connection.close()


class Server:
    """The scene on its own port; `more` is code appended to the child script."""

    def __init__(self, folder: Path, *options: object, more: str = "") -> None:
        self.port = free_port()
        script = (REPOSITORY / "scenes" / "tricycle_socket.py").read_text()
        assert "('127.0.0.1', 5000)" in script
        self.script = folder / "script.py"
        self.script.write_text(script.replace("5000", str(self.port)) + more)
        arguments = ["tricycle_socket", "--no-ros", "--child-script", f"/Tricycle={self.script}", *options]
        self.node = Node(dict(os.environ), folder / "log", *arguments)
        wait_until(self._listens, "the server to listen")

    def _listens(self) -> bool:
        with socket.socket() as probe:
            return probe.connect_ex(("127.0.0.1", self.port)) == 0


@pytest.fixture(scope="module")
def server(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Server]:
    server = Server(tmp_path_factory.mktemp("server"))
    with server.node:
        yield server
        assert "error" not in server.node.output


@pytest.fixture
def client(server: Server) -> Iterator[Client]:
    client = Client(server.port)
    yield client
    client.close()


def test_each_command_is_answered_with_time_and_distance(client: Client) -> None:
    first, second = client.ask(b"0.1;0.5"), client.ask(b"0.1;0.5")
    assert ANSWER.fullmatch(first)
    assert ANSWER.fullmatch(second)
    assert float(second.split(";")[0]) > float(first.split(";")[0])


def test_a_command_may_come_in_pieces_and_several_at_once(client: Client) -> None:
    assert ANSWER.fullmatch(client.ask(b"0;0"))  # answers end with a newline
    client.send(b"0.1;")
    client.send(b"0.")
    client.send(b"5\n0;1\r\n 0 ; 2 \n")
    assert all(ANSWER.fullmatch(client.line()) for _ in range(3))


def test_a_client_that_ends_no_lines_is_answered_too(client: Client) -> None:
    client.send(b"0.1;0.5")
    assert ANSWER.fullmatch(client.line())
    client.send(b"0.1;0.5")
    assert ANSWER.fullmatch(client.line())


JUNK = [b"", b"hello", b"1", b"1;2;3", b"nan;1", b"1;inf", b"1;-inf", b"\xff\xfe;1", b"1;1e999", b"1,5;2", b"\0;\0"]


@pytest.mark.parametrize("junk", JUNK[1:], ids=repr)
def test_junk_is_answered_with_what_was_expected(client: Client, junk: bytes) -> None:
    answer = client.ask(junk)
    assert answer.startswith("error: expected 'steering;speed', two numbers such as 0.5;1.0, found '")
    assert ANSWER.fullmatch(client.ask(b"0;0"))


@settings(deadline=None, max_examples=30, suppress_health_check=[HealthCheck.too_slow])  # on a busy machine
@given(st.lists(st.binary(max_size=60).filter(lambda line: b"\n" not in line and line.strip()), max_size=5))
def test_every_line_has_one_answer(server: Server, lines: list[bytes]) -> None:
    client = Client(server.port)
    try:
        client.send(b"".join(line + b"\n" for line in lines) + b"0;0\n")
        answers = [client.line() for _ in range(len(lines) + 1)]
        assert ANSWER.fullmatch(answers[-1])
        assert all(ANSWER.fullmatch(answer) or answer.startswith("error: ") for answer in answers)
    finally:
        client.close()


def test_a_line_without_end_costs_the_connection(server: Server, client: Client) -> None:
    with contextlib.suppress(ConnectionError):  # the connection is closed before everything is sent
        client.send(b"1" * 1_000_000)
    client.connection.settimeout(DEADLINE)
    with contextlib.suppress(ConnectionError):  # and the answer may be lost with it
        assert client.line() in ("error: a line of more than 200 bytes", "")
    assert ANSWER.fullmatch(Client(server.port).ask(b"0;0"))


def test_clients_that_vanish_or_never_read_disturb_nobody(server: Server, client: Client) -> None:
    Client(server.port).reset()
    silent = Client(server.port)
    silent.connection.setblocking(False)
    half = Client(server.port)
    half.send(b"0.1;0.")
    half.reset()
    vanishing = Client(server.port)
    vanishing.send(b"0;0\n" * 10)
    vanishing.reset()
    for _ in range(20):
        with contextlib.suppress(BlockingIOError):
            silent.connection.send(b"junk\n" * 1000)
        assert ANSWER.fullmatch(client.ask(b"0;0"))
    silent.close()


def test_too_many_clients_are_refused(server: Server) -> None:
    clients = [Client(server.port) for _ in range(200)]
    try:
        for client in clients:
            client.send(b"0;0\n")
        answers = [client.line() for client in clients]
        served = [answer for answer in answers if ANSWER.fullmatch(answer)]
        refused = [answer for answer in answers if "32 clients are connected already" in answer]
        assert 0 < len(served) <= MOST_CLIENTS
        assert len(served) + len(refused) == len(clients)
    finally:
        for client in clients:
            client.close()
    wait_until(lambda: ANSWER.fullmatch(ask_once(server.port)) is not None, "a place to be free again")


def ask_once(port: int) -> str:
    client = Client(port)
    try:
        return client.ask(b"0;0")
    except OSError:
        return ""
    finally:
        client.close()


def test_junk_leaves_the_last_good_command_in_force(tmp_path: Path) -> None:
    server = Server(tmp_path, more=PRINT_TARGETS)
    with server.node:
        wait_until(lambda: "targets 0.0 0.0" in server.node.output, "a step without a command")
        client = Client(server.port)
        client.ask(b"0.25;1.5")
        for junk in JUNK[1:]:
            client.ask(junk)
        client.ask(b"0.5;2.5")
        client.close()
        wait_until(lambda: "targets 0.5 2.5" in server.node.output, "the last command")
        assert server.node.end() == 0  # before that the last line may be incomplete
        printed = without_slowness(server.node.output).splitlines()
        assert set(printed) == {"targets 0.0 0.0", "targets 0.25 1.5", "targets 0.5 2.5"}


def test_the_port_is_free_again_at_once(tmp_path: Path) -> None:
    for name in ("first", "second"):
        folder = tmp_path / name
        folder.mkdir()
    first = Server(tmp_path / "first")
    with first.node:
        client = Client(first.port)
        assert ANSWER.fullmatch(client.ask(b"0;0"))
        assert first.node.end() == 0
    arguments = ["tricycle_socket", "--no-ros", "--child-script", f"/Tricycle={first.script}", "--until", "0.1"]
    with Node(dict(os.environ), tmp_path / "log", *arguments) as again:
        assert again.process.wait(timeout=DEADLINE) == 0
        assert without_slowness(again.output) == ""
    client.close()


def test_a_port_in_use_is_reported(tmp_path: Path, server: Server) -> None:
    arguments = ["tricycle_socket", "--no-ros", "--child-script", f"/Tricycle={server.script}", "--strict"]
    with Node(dict(os.environ), tmp_path / "log", *arguments) as second:
        wait_until(lambda: second.process.poll() is not None, "the second simulation to end")
        assert second.process.returncode == 3
        assert f"cannot listen on 127.0.0.1:{server.port}" in second.output
        assert "is another simulation running?" in second.output


def client_program(port: int) -> list[str]:
    return [sys.executable, "-u", str(REPOSITORY / "scripts" / "tricycle_socket_client.py"), "--port", str(port)]


def test_the_client_drives_until_it_is_interrupted_and_stops_the_tricycle(tmp_path: Path) -> None:
    server = Server(tmp_path, "--speed", "20", more=PRINT_TARGETS)
    with server.node:
        log = tmp_path / "client"
        with log.open("w") as output:
            process = start(client_program(server.port), dict(os.environ), stdout=output, stderr=subprocess.STDOUT)
        try:
            wait_until(lambda: "driving the tricycle" in log.read_text(), "the client to be connected")
            wait_until(lambda: "targets 0.0 1.0" in server.node.output, "the tricycle to be at full speed")
            wait_until(lambda: "targets 1.22" in server.node.output, "the tricycle to turn away from something")
            process.send_signal(signal.SIGINT)
            assert process.wait(timeout=DEADLINE) == 0
            wait_until(lambda: re.search(r" 0\.0\n.*\Z", server.node.output) is not None, "the tricycle to be stopped")
        finally:
            stop(process)


def test_the_client_states_when_there_is_no_simulation() -> None:
    run = subprocess.run(client_program(free_port()), capture_output=True, text=True, timeout=60, check=False)
    assert run.returncode == 1
    assert "start `rosrun bubblesim sim tricycle_socket`" in run.stderr
    assert "Traceback" not in run.stderr
