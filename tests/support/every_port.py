# SPDX-License-Identifier: BSD-3-Clause
"""A simulator that listens on every kind of port that it has, and a polite client of each."""

import os
import socket
import struct
import time
import xmlrpc.client
from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Any
from urllib.parse import urlsplit

import cbor2
import zmq

from node_support import NAME, Node
from process_support import listening_ports, open_files
from ros_support import DEADLINE, REPOSITORY, RosCore, free_port, stopped_on_failure, wait_until
from web_support import TOKEN

PORTS = ("XML-RPC", "TCPROS", "remote API", "window", "script")
"""The kinds of ports. The last one is opened by a child script, that of the scene tricycle_socket."""


def subscriber_header(topic: str) -> bytes:
    """Return what a subscriber of any type sends first on a TCPROS connection."""
    fields = (f"topic={topic}", "callerid=/test", "md5sum=*", "type=*")
    header = b"".join(struct.pack("<I", len(field)) + field.encode() for field in fields)
    return struct.pack("<I", len(header)) + header


class ListeningNode(Node):
    """The node with ROS, the window, the remote API and a server of a child script; `ports` are its TCP ports."""

    def __init__(
        self,
        core: RosCore,
        folder: Path,
        *options: object,
        limit: int | None = None,
        env: Mapping[str, str] | None = None,
    ) -> None:
        """Start it and wait until all ports answer.

        :param limit: how many descriptors each of its processes may have open.
        :param env: more variables of its environment.
        """
        remote, window, script = (free_port() for _ in range(3))
        code = (REPOSITORY / "scenes" / "tricycle_socket.py").read_text()
        file = folder / f"script_{script}.py"
        file.write_text(code.replace("5000", str(script)))
        ports = (f"--remote={remote}", f"--web={window}", "--start", "--child-script", f"/Tricycle={file}")
        within = ("prlimit", f"--nofile={limit}") if limit else ()
        log = folder / f"node_{script}.txt"
        super().__init__(core.env | TOKEN | dict(env or {}), log, "tricycle_socket", *ports, *options, within=within)
        with stopped_on_failure(self.process):
            self._find_ports(core, remote, window, script)

    def _find_ports(self, core: RosCore, remote: int, window: int, script: int) -> None:
        """Set ``ports`` and wait until polite clients get an answer on each."""
        self.wait_for_output("remote clients can connect")
        self.wait_for_output("the window is at")
        self.wait_until_ready(core)
        slave: Any = xmlrpc.client.ServerProxy(core.env["ROS_MASTER_URI"])
        xml_rpc = urlsplit(slave.lookupNode("/test", NAME)[2]).port
        node: Any = xmlrpc.client.ServerProxy(f"http://127.0.0.1:{xml_rpc}")
        tcpros = node.requestTopic("/test", "/clock", [["TCPROS"]])[2][2]
        self.ports = dict(zip(PORTS, (xml_rpc, tcpros, remote, window, script), strict=True))
        for port in PORTS:
            wait_until(lambda port=port: self.is_answered(port), f"the port of {port}")

    def server(self, port: str) -> int:
        """Return the process that listens on a port."""
        if port != "window":
            return self.process.pid
        return next(pid for pid in children(self.process.pid) if self.ports[port] in listening_ports(pid))

    def connect(self, port: str, timeout: float = DEADLINE) -> socket.socket:
        """Open a connection, and send nothing."""
        return socket.create_connection(("127.0.0.1", self.ports[port]), timeout=timeout)

    def ask(self, port: str) -> float:
        """Let a polite client connect and ask for something; return the seconds until it had its answer."""
        begin = time.monotonic()
        _POLITE[port](self)
        return time.monotonic() - begin

    def is_answered(self, port: str) -> bool:
        """Return whether a polite client gets its answer."""
        try:
            self.ask(port)
        except (OSError, AssertionError):
            return False
        return True

    def time(self) -> float:
        """Return the simulated time, which the answers of the child script have."""
        with self.connect("script") as connection, connection.makefile("rb") as answers:
            connection.sendall(b"0;0\n")
            answer = answers.readline()
        assert b";" in answer, answer
        return float(answer.split(b";")[0])


def _ask_xml_rpc(node: ListeningNode) -> None:
    api: Any = xmlrpc.client.ServerProxy(f"http://127.0.0.1:{node.ports['XML-RPC']}")
    with api:
        assert api.getPid("/test")[0] == 1


def _ask_tcpros(node: ListeningNode) -> None:
    with node.connect("TCPROS") as connection:
        connection.sendall(subscriber_header("/clock"))
        assert connection.recv(4)


def _ask_remote_api(node: ListeningNode) -> None:
    client = zmq.Context.instance().socket(zmq.REQ)
    client.setsockopt(zmq.LINGER, 0)
    client.setsockopt(zmq.RCVTIMEO, int(1000 * DEADLINE))
    client.connect(f"tcp://127.0.0.1:{node.ports['remote API']}")
    try:
        client.send(cbor2.dumps({"func": "sim.getSimulationTime", "args": [], "uuid": "polite"}))
        assert "ret" in cbor2.loads(client.recv())
    finally:
        client.close()


def _ask_window(node: ListeningNode) -> None:
    request = f"GET /icon.svg HTTP/1.1\r\nHost: 127.0.0.1:{node.ports['window']}\r\n\r\n".encode()
    with node.connect("window") as connection:
        connection.sendall(request)
        answer = connection.recv(4096)
    assert b" 200 " in answer, answer


def _ask_script(node: ListeningNode) -> None:
    node.time()


_POLITE: dict[str, Callable[[ListeningNode], None]] = dict(
    zip(PORTS, (_ask_xml_rpc, _ask_tcpros, _ask_remote_api, _ask_window, _ask_script), strict=True)
)


def children(pid: int) -> list[int]:
    """Return the processes that a process has started, and theirs."""
    found: list[int] = []
    for task in Path(f"/proc/{pid}/task").iterdir():
        for child in (task / "children").read_text().split():
            found += [int(child), *children(int(child))]
    return found


def reset(connection: socket.socket) -> None:
    """Close a connection as the kernel does for a client that is killed with unread data."""
    connection.setsockopt(socket.SOL_SOCKET, socket.SO_LINGER, struct.pack("ii", 1, 0))
    connection.close()


def cpu_seconds(pid: int) -> float:
    """Return the processor time that a process has used."""
    fields = Path(f"/proc/{pid}/stat").read_text().rpartition(")")[2].split()
    return (int(fields[11]) + int(fields[12])) / os.sysconf("SC_CLK_TCK")


def most_open_files(pid: int) -> int:
    """Return the most descriptors that a process has open within a second: some come and go."""
    most = 0
    for _ in range(20):
        most = max(most, open_files(pid))
        time.sleep(0.05)
    return most


def wait_for_descriptors(pid: int, most: int) -> None:
    """Wait until a process has at most so many open."""
    what = f"at most {most} open files"
    wait_until(lambda: open_files(pid) <= most, lambda: f"{what}, found {open_files(pid)}", 3 * DEADLINE)
