# SPDX-License-Identifier: BSD-3-Clause
"""Harm that peers can do to our roscpp nodes through XML-RPC and TCPROS ports: real nodes, real sockets."""

import contextlib
import itertools
import re
import socket
import struct
import subprocess
import time
import xmlrpc.client
from collections.abc import Iterator
from pathlib import Path
from typing import Any
from urllib.parse import urlsplit

import pytest

from node_support import Background, write
from ros_support import DEADLINE, RosCore, built, free_port, start, stop, wait_until

NODES: dict[str, list[str]] = {"sim": ["tricycle"], "pointcloud_to_laserscan": []}
ANY_ADDRESS = "00000000"
LOOPBACK = "0100007F"
CALL = "<?xml version='1.0'?><methodCall><methodName>{}</methodName><params>{}</params></methodCall>"
GET_PID = (
    "<value><struct><member><name>methodName</name><value>getPid</value></member><member><name>params</name>"
    "<value><array><data><value>/test</value></data></array></value></member></struct></value>"
)
MULTICALL = GET_PID.replace("getPid", "system.multicall")


numbers = itertools.count()


def listens(pid: int) -> set[str]:
    """Return the addresses of the listening TCP sockets of a process, from /proc."""
    sockets = set()
    for entry in Path(f"/proc/{pid}/fd").iterdir():
        with contextlib.suppress(OSError):
            sockets.add(entry.readlink().name)
    lines = [line.split() for line in Path("/proc/net/tcp").read_text().splitlines()[1:]]
    return {line[1].split(":")[0] for line in lines if line[3] == "0A" and f"socket:[{line[9]}]" in sockets}


class Node(Background):
    """One of our nodes with its name, log, and listening addresses."""

    def __init__(
        self, program: str, env: dict[str, str], folder: Path, *arguments: str, before: tuple[str, ...] = ()
    ) -> None:
        self.name = name = f"peer_{next(numbers)}"
        self._log = folder / f"{name}.log"
        where = program if program.startswith("/") else str(built(program))
        command = [*before, where, *NODES.get(program, []), *arguments, f"__name:={name}"]
        with self._log.open("w") as output:
            self.process = start(command, env, stdout=output, stderr=subprocess.STDOUT)
        master: Any = xmlrpc.client.ServerProxy(env["ROS_MASTER_URI"])
        wait_until(lambda: master.lookupNode("/test", f"/{name}")[0] == 1, "the node to be listed")
        self.port: int = urlsplit(master.lookupNode("/test", f"/{name}")[2]).port or 0

    @property
    def output(self) -> str:
        return self._log.read_text(errors="replace")

    @property
    def api(self) -> Any:
        return xmlrpc.client.ServerProxy(f"http://127.0.0.1:{self.port}")

    def listens(self) -> set[str]:
        return listens(self.process.pid)

    def tcpros_port(self, topic: str) -> int:
        code, message, answer = self.api.requestTopic("/test", topic, [["TCPROS"]])
        assert code == 1, message
        return int(answer[2])

    def post(self, body: bytes) -> bytes:
        """Send one request; return the response until the node closes, b"" if it refuses to read."""
        head = f"POST / HTTP/1.0\r\nContent-Type: text/xml\r\nContent-length: {len(body)}\r\n\r\n".encode()
        with socket.create_connection(("127.0.0.1", self.port), timeout=60) as connection:
            answer = b""
            with contextlib.suppress(ConnectionError):
                connection.sendall(head + body)
                while piece := connection.recv(1 << 16):
                    answer += piece
        return answer

    def call(self, method: str, *values: str) -> bytes:
        return self.post(CALL.format(method, "".join(f"<param>{value}</param>" for value in values)).encode())

    def check_alive(self) -> None:
        assert self.api.getPid("/test")[:2] == [1, ""]
        assert self.process.poll() is None, self.output


@pytest.fixture(scope="module")
def core(tmp_path_factory: pytest.TempPathFactory) -> Iterator[RosCore]:
    """A master for all tests, whose nodes have different names."""
    with RosCore(tmp_path_factory.mktemp("roslog")) as core:
        yield core


@pytest.fixture(scope="module", params=NODES)
def shared_node(
    request: pytest.FixtureRequest, core: RosCore, tmp_path_factory: pytest.TempPathFactory
) -> Iterator[Node]:
    with Node(request.param, core.env, tmp_path_factory.mktemp("log")) as running:
        yield running


@pytest.fixture
def node(shared_node: Node) -> Iterator[Node]:
    """A node that must still be alive after the test."""
    yield shared_node
    shared_node.check_alive()


@pytest.fixture
def sim(core: RosCore, tmp_path: Path) -> Iterator[Node]:
    with Node("sim", core.env, tmp_path) as running:
        yield running
        running.check_alive()


def environment(core: RosCore, **chosen: str) -> dict[str, str]:
    """Return the environment of the master's clients, with this choice of an address."""
    return {name: value for name, value in core.env.items() if name not in ("ROS_HOSTNAME", "ROS_IP")} | chosen


@pytest.mark.parametrize(
    ("chosen", "addresses"),
    [
        ({"ROS_HOSTNAME": "127.0.0.1"}, {LOOPBACK}),
        ({"ROS_HOSTNAME": "localhost"}, {LOOPBACK}),
        ({"ROS_IP": "127.0.0.1"}, {LOOPBACK}),
        ({}, {LOOPBACK}),  # as the master, which is on localhost
    ],
)
@pytest.mark.parametrize("program", NODES)
def test_ports_listen_on_the_address_that_the_user_chose(
    core: RosCore, tmp_path: Path, program: str, chosen: dict[str, str], addresses: set[str]
) -> None:
    with Node(program, environment(core, **chosen), tmp_path) as node:
        assert node.listens() == addresses


def test_with_a_master_for_all_machines_ports_listen_on_all_addresses(core: RosCore, tmp_path: Path) -> None:
    master = environment(core)["ROS_MASTER_URI"].replace("localhost", socket.gethostname())
    with Node("sim", environment(core, ROS_MASTER_URI=master), tmp_path) as node:
        assert node.listens() == {ANY_ADDRESS}


def test_an_address_of_the_command_line_counts(core: RosCore, tmp_path: Path) -> None:
    with Node("sim", environment(core), tmp_path, "__ip:=127.0.0.1") as node:
        assert node.listens() == {LOOPBACK}


@pytest.mark.parametrize(
    ("chosen", "addresses"), [({}, {LOOPBACK}), ({"ROS_IP": "127.0.0.1"}, {LOOPBACK}), ({"ROS_IP": ""}, {LOOPBACK})]
)
def test_nodes_in_python_listen_as_those_in_cpp(
    core: RosCore, tmp_path: Path, chosen: dict[str, str], addresses: set[str]
) -> None:
    with Node("tricycle_avoid.py", environment(core, **chosen), tmp_path) as node:
        assert node.listens() == addresses


@pytest.mark.parametrize("addresses", [["127.0.1.1"], ["127.0.0.1", "192.0.2.7"]], ids=["only here", "several"])
def test_a_name_without_one_address_opens_all(core: RosCore, tmp_path: Path, addresses: list[str]) -> None:
    hosts = write(
        tmp_path / "hosts", "127.0.0.1 localhost\n" + "".join(f"{each} robot.example\n" for each in addresses)
    )
    mounted = (
        "unshare",
        "--map-root-user",
        "--mount",
        "bash",
        "-c",
        f'mount --bind {hosts} /etc/hosts; exec "$0" "$@"',
    )
    if subprocess.run([*mounted, "true"], check=False).returncode:
        pytest.skip("this user may not mount anything")
    with Node("sim", environment(core, ROS_HOSTNAME="robot.example"), tmp_path, before=mounted) as node:
        assert node.listens() == {ANY_ADDRESS}


@pytest.mark.parametrize(("chosen", "addresses"), [({}, {ANY_ADDRESS}), ({"ROS_HOSTNAME": "localhost"}, {LOOPBACK})])
def test_a_master_listens_on_all_addresses_unless_it_is_on_loopback(
    core: RosCore, tmp_path: Path, chosen: dict[str, str], addresses: set[str]
) -> None:
    env = environment(core, **chosen)
    with (tmp_path / "log").open("w") as output:
        master = start(["rosmaster", "--core", "-p", str(free_port())], env, stdout=output, stderr=subprocess.STDOUT)
    try:
        wait_until(lambda: listens(master.pid) != set(), "the master's port")
        assert listens(master.pid) == addresses
    finally:
        stop(master)


def test_an_address_of_no_interface_is_a_warning(core: RosCore, tmp_path: Path) -> None:
    unknown = "192.0.2.1"  # in TEST-NET-1 (RFC 5737)
    with Node("sim", environment(core, ROS_HOSTNAME=unknown), tmp_path) as node:
        assert node.listens() == {ANY_ADDRESS}
        assert node.output.count(f"'{unknown}' (ROS_HOSTNAME, ROS_IP), which is not an address of this machine") == 1
        node.check_alive()


def test_sockets_of_scripts_bind_what_they_ask_for(core: RosCore, tmp_path: Path) -> None:
    code = """\
        #python
        import socket

        def sysCall_init():
            self.server = socket.create_server(('0.0.0.0', 0))
            print('bound to', self.server.getsockname()[0])
        """
    script = write(tmp_path / "server.py", code)
    with Node("sim", core.env, tmp_path, "--child-script", f"/Tricycle={script}") as node:
        wait_until(lambda: "bound to 0.0.0.0" in node.output, "the script's socket")
        assert node.listens() == {LOOPBACK, ANY_ADDRESS}


def nested(depth: int) -> str:
    """Return a value with `depth` nested values."""
    return "<value><array><data>" * (depth - 1) + "<value>1</value>" + "</data></array></value>" * (depth - 1)


def test_arrays_nested_100000_deep_are_refused(node: Node) -> None:
    assert b"100 deep" in node.call("getPid", nested(100_000))


UNREADABLE = {
    "deep": "<value><array><data>" * 200_000,
    "deep and long": "<value><array><data>" * 99 + "<value>" + "x" * 4_000_000,
    "strings without their end": "<value><array><data>" + "<value>a" * 20_000,
}


@pytest.mark.parametrize("kind", UNREADABLE)
def test_values_that_cannot_be_read_take_no_longer_than_others_of_their_size(node: Node, kind: str) -> None:
    def took(value: str) -> float:
        """Return the least of some times, because the machine may be busy."""
        times = []
        for _ in range(5):
            begin = time.monotonic()
            node.call("getPid", value)
            times.append(time.monotonic() - begin)
        return min(times)

    assert b"cannot be read" in node.call("getPid", UNREADABLE[kind])
    readable = "<value><i4>1</i4></value>" * (len(UNREADABLE[kind]) // 25)
    assert took(UNREADABLE[kind]) < 3 * took(f"<value><array><data>{readable}</data></array></value>")


def test_closing_tags_in_names_do_not_hide_the_depth(node: Node) -> None:
    level = "<value><struct><member><name>" + "</value></struct></member>" * 3 + "</name>"
    assert b"100 deep" in node.call("getPid", level * 100_000)


@pytest.mark.parametrize(("depth", "answered"), [(100, True), (101, False)])
def test_values_may_be_nested_100_deep(node: Node, depth: int, answered: bool) -> None:
    assert (f"<i4>{node.process.pid}</i4>".encode() in node.call("getPid", nested(depth))) == answered


def test_a_multicall_in_a_multicall_is_refused(node: Node) -> None:
    answer = node.call("system.multicall", f"<value><array><data>{GET_PID}{MULTICALL}</data></array></value>")
    assert b"faultString" in answer
    assert b"cannot call itself" in answer


def test_a_flat_multicall_is_answered(node: Node) -> None:
    calls = [{"methodName": "getPid", "params": ["/test"]}, {"methodName": "nothing", "params": []}]
    (pid,), failed = getattr(node.api, "system.multicall")(calls)
    assert pid == [1, "", node.process.pid]
    assert "unknown method" in failed["faultString"]


def test_bodies_over_16_megabytes_are_not_read(node: Node) -> None:
    text = "x" * (8 << 20)
    assert f"<i4>{node.process.pid}</i4>".encode() in node.call("getPid", f"<value>{text}</value>")
    assert node.call("getPid", f"<value>{text * 2}</value>") == b""


def test_a_header_without_end_is_not_buffered(node: Node) -> None:
    connection = socket.create_connection(("127.0.0.1", node.port), timeout=60)
    with connection, pytest.raises(ConnectionError):
        connection.sendall(b"x" * (64 << 20))
    memory = re.search(r"VmHWM:\s+(\d+) kB", Path(f"/proc/{node.process.pid}/status").read_text())
    assert memory
    assert int(memory[1]) < 600_000


@pytest.mark.parametrize("name", ["publisherUpdate", "requestTopic", "paramUpdate", "getBusInfo", "nothing"])
@pytest.mark.parametrize("value", ["<value><i4>x</i4></value>", "<value><struct></struct></value>", "", "<value>"])
def test_odd_parameters_are_answered(node: Node, name: str, value: str) -> None:
    for count in range(4):
        assert b"200 OK" in node.call(name, *[value] * count)


def test_lengths_beyond_a_tcpros_header_end_its_connection(sim: Node) -> None:
    port = sim.tcpros_port("/tf")
    for _ in range(50):
        with socket.create_connection(("127.0.0.1", port), timeout=60) as connection:
            connection.sendall(struct.pack("<II", 8, 1_000_000) + b"abcd")
            with contextlib.suppress(ConnectionError):
                assert connection.recv(1) == b""


def test_junk_is_logged_in_a_few_lines(sim: Node) -> None:
    port = sim.tcpros_port("/tf")
    line = b"a line without an equals sign"
    unreadable = struct.pack("<II", 4 + len(line), len(line)) + line
    service = b"service=/of_nobody"
    of_nobody = struct.pack("<II", 4 + len(service), len(service)) + service
    request = b"GET / HTTP/1.0\r\n\r\n"
    for _ in range(100):
        for target, junk in ((sim.port, request), (port, request), (port, unreadable), (port, of_nobody)):
            with socket.create_connection(("127.0.0.1", target), timeout=60) as connection:
                connection.sendall(junk)
                connection.shutdown(socket.SHUT_WR)
                with contextlib.suppress(ConnectionError):
                    connection.recv(1)
    wait_until(lambda: "suppressing more lines about connections of peers" in sim.output, "the limit")
    assert len(sim.output.splitlines()) < 30


def test_any_caller_can_shut_a_node_down(core: RosCore, tmp_path: Path) -> None:
    """As `rosnode kill` does: roscpp does not check who calls."""
    with Node("sim", core.env, tmp_path) as running:
        running.wait_until_ready(core, f"/{running.name}")
        assert running.api.shutdown("/other", "for no reason")[0] == 1
        assert running.process.wait(DEADLINE) == 0


@pytest.fixture
def plain(core: RosCore, tmp_path: Path) -> Iterator[Node]:
    """A roscpp node without our limits."""
    with Node("/usr/lib/topic_tools/relay", environment(core), tmp_path, "/in", "/out") as running:
        yield running


@pytest.mark.parametrize(
    "body",
    [CALL.format("getPid", f"<param>{nested(100_000)}</param>"), CALL.format("system.multicall", "")],
    ids=["nested values", "nested multicall"],
)
def test_such_a_request_crashes_a_plain_roscpp_node(plain: Node, body: str) -> None:
    if "multicall" in body:
        inner = MULTICALL.replace("<value>/test</value>", f"<value><array><data>{GET_PID}</data></array></value>")
        body = CALL.format("system.multicall", f"<param><value><array><data>{inner}</data></array></value></param>")
    with contextlib.suppress(ConnectionError):
        plain.post(body.encode())
    assert plain.process.wait(DEADLINE) < 0  # by a signal


def test_a_body_without_end_fills_the_memory_of_a_plain_roscpp_node(plain: Node) -> None:
    def memory() -> int:
        return int(Path(f"/proc/{plain.process.pid}/statm").read_text().split()[1]) >> 8  # MiB

    before = memory()
    with socket.create_connection(("127.0.0.1", plain.port), timeout=60) as connection:
        connection.sendall(b"POST / HTTP/1.0\r\nContent-Type: text/xml\r\nContent-length: 2000000000\r\n\r\n")
        for _ in range(64):
            connection.sendall(bytes(1 << 20))
        wait_until(lambda: memory() - before > 50, "the memory to fill")
