# SPDX-License-Identifier: BSD-3-Clause
"""Real ROS processes for tests: a master on its own port, and the paths of the built files.

Use as a pytest fixture: ``from ros_support import roscore`` in a conftest.py or test module.
"""

import contextlib
import fcntl
import itertools
import os
import signal
import socket
import subprocess
import time
import xmlrpc.client
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from pathlib import Path
from types import TracebackType
from typing import Any
from urllib.parse import urlsplit

import pytest

from bubblesim.program.groups import signal_group

SUPPORT = Path(__file__).resolve().parent
REPOSITORY = SUPPORT.parents[1]
DEADLINE = 40.0 * float(os.environ.get("BUBBLESIM_TEST_DEADLINE_FACTOR", "1"))
"""Seconds after which an expected event counts as missing; long, because machines may be busy, and longer for builds
with sanitizers."""


def built(name: str) -> Path:
    """Return the path of the built program or library `name`: in BUBBLESIM_BUILD_DIR (searched recursively), or else in
    the workspace made by scripts/setup."""
    directory = os.environ.get("BUBBLESIM_BUILD_DIR")
    if directory:
        found = [path for path in sorted(Path(directory).rglob(name)) if path.is_file()]
    else:
        devel = REPOSITORY / ".ws" / "devel"
        places = [devel / "lib" / "bubblesim" / name, devel / "lib" / name]
        found = [path for path in places if path.is_file()]
    if not found:
        pytest.fail(f"{name} is not built: build with BUBBLESIM_BUILD_TESTS=ON, or point BUBBLESIM_BUILD_DIR to it")
    return found[0]


def _worker_ports() -> Iterator[int]:
    """Yield ports for the tests of this process: below the kernel's ephemeral ports, above those that browsers refuse
    (10080 is the last) and that ROS and isolated runs use, and distinct from those of the other test processes (the
    workers of pytest-xdist)."""
    worker = int(os.environ.get("PYTEST_XDIST_WORKER", "gw0").removeprefix("gw"))
    first = 12000 + 2000 * (worker % 10)
    return itertools.cycle(range(first + os.getpid() % 1000, first + 2000))


_PORTS = _worker_ports()


def free_port() -> int:
    """Return a port of 127.0.0.1 that is not in use and that no other test gets."""
    return next(port for port in _PORTS if _is_free(port))


def _is_free(port: int) -> bool:
    with socket.socket() as probe:
        probe.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
        try:
            probe.bind(("127.0.0.1", port))
        except OSError:
            return False
    return True


@contextlib.contextmanager
def alone_on_port(port: int) -> Iterator[None]:
    """Keep the other test processes from a port that is fixed, because a page or a program names it."""
    with Path("/tmp", f"bubblesim_tests_{os.getuid()}_port_{port}").open("w") as lock:
        fcntl.flock(lock, fcntl.LOCK_EX)
        yield


def wait_until(condition: Callable[[], bool], what: str | Callable[[], str], timeout: float = DEADLINE) -> None:
    """Return as soon as `condition` holds; fail the test with `what`, or what it returns then, at the timeout."""
    begin = time.monotonic()
    while not condition():
        waited = time.monotonic() - begin
        if waited > timeout:
            pytest.fail(f"waited {timeout:g} s in vain for {what if isinstance(what, str) else what()}")
        time.sleep(until_next_look(waited))


def until_next_look(waited: float) -> float:
    """Return how long to sleep before looking again, in seconds: a look at the master or a page takes their time from
    what is waited for."""
    return min(max(0.02, 0.05 * waited), 0.2)


@contextlib.contextmanager
def stopped_on_failure(process: "subprocess.Popen[str]") -> Iterator[None]:
    """Stop a process that has not become ready: no block holds it yet."""
    try:
        yield
    except BaseException:
        stop(process)
        raise


def ros_environment(port: int, log_directory: Path) -> dict[str, str]:
    """Return the environment for a process to use the master on `port` of this machine."""
    return {
        **os.environ,
        "PATH": "/usr/bin:" + os.environ.get("PATH", ""),  # Debian's python3 first: ROS is built for it
        "ROS_MASTER_URI": f"http://localhost:{port}",
        "ROS_HOSTNAME": "localhost",
        "ROS_LOG_DIR": str(log_directory),
        "PYTHONUNBUFFERED": "1",
    }


def start(command: list[str], env: dict[str, str], **options: object) -> "subprocess.Popen[str]":
    """Start a process in its own group, with signals as in a foreground shell."""
    return subprocess.Popen(  # type: ignore[call-overload, no-any-return]
        command, env=env, text=True, start_new_session=True, restore_signals=True, **options
    )


def stop(process: "subprocess.Popen[str]", timeout: float = 10.0) -> None:
    """End a process of start() and everything that it started; kill it after `timeout` seconds."""
    if process.poll() is None:
        assert os.getpgid(process.pid) == process.pid, "only start() makes a group to end"
    for number in (signal.SIGINT, signal.SIGKILL):
        try:
            signal_group(process, number)
            process.wait(timeout=timeout)
        except (ProcessLookupError, subprocess.TimeoutExpired):
            continue


def stop_launch(process: "subprocess.Popen[str]") -> None:
    """End a roslaunch. Its nodes have groups of their own and would outlive it: it waits up to 17 s for them."""
    stop(process, 2 * DEADLINE)


OF_ONE_TYPE = ("/clock", "/diagnostics", "/rosout", "/rosout_agg", "/tf", "/tf_static")


_UNREGISTER = {
    "publishers": "unregisterPublisher",
    "subscribers": "unregisterSubscriber",
    "services": "unregisterService",
}


def nodes_of(state: dict[str, dict[str, list[str]]]) -> set[str]:
    """Return the nodes in a master's registrations."""
    return {node for book in state.values() for nodes in book.values() for node in nodes}


def is_served(address: str) -> bool:
    """Return whether a process listens at an address, http://HOST:PORT/, such as that of a node."""
    place = urlsplit(address)
    try:
        socket.create_connection((place.hostname or "", place.port or 0), timeout=1.0).close()
    except OSError:
        return False
    return True


class RosCore:
    """A running roscore. `env` is the environment of its clients; as a context manager it ends with the block."""

    def __init__(self, directory: Path, port: int | None = None) -> None:
        self.port = port or free_port()
        self.env = ros_environment(self.port, directory)
        self.process = start(
            ["roscore", "-p", str(self.port)], self.env, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL
        )
        with stopped_on_failure(self.process):
            # The last thing that it does.
            wait_until(lambda: "/rosout" in self.state()["subscribers"], "roscore to start")
        self._master_pid = int(self._ask_master("getPid", "/test"))
        self._first_state = self._registered()

    def __enter__(self) -> "RosCore":
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, traceback: TracebackType | None
    ) -> None:
        self.resume()
        stop(self.process)

    def state(self) -> dict[str, dict[str, list[str]]]:
        """Return the master's registrations: {"publishers": {topic: [node, ...]}, "subscribers": ..., "services": ...};
        empty while it does not answer."""
        kinds = ("publishers", "subscribers", "services")
        try:
            books = self._ask_master("getSystemState", "/test")
        except (OSError, xmlrpc.client.Error):
            return {kind: {} for kind in kinds}
        return {kind: dict(book) for kind, book in zip(kinds, books, strict=True)}

    @property
    def _master(self) -> Any:
        return xmlrpc.client.ServerProxy(self.env["ROS_MASTER_URI"])

    def _ask_master(self, method: str, *arguments: Any) -> Any:
        code, message, value = getattr(self._master, method)(*arguments)
        assert code == 1, message
        return value

    def forget_ended_nodes(self) -> None:
        """Unregister the nodes that are no more, as `rosnode cleanup` does. Others may be about to unregister."""
        state = self.state()
        for node in nodes_of(state):
            code, _, address = self._master.lookupNode("/test", node)
            if code != 1 or is_served(address):
                continue
            for kind, book in state.items():
                for name in [name for name, nodes in book.items() if node in nodes]:
                    place = self._master.lookupService("/test", name)[2] if kind == "services" else address
                    getattr(self._master, _UNREGISTER[kind])(node, name, place)

    def is_as_new(self) -> bool:
        """Return whether no node, service or parameter of tests is left."""
        try:
            return self.process.poll() is None and self._registered() == self._first_state
        except (OSError, xmlrpc.client.Error):
            return False

    def _registered(self) -> tuple[object, object]:
        return self.state(), sorted(self._ask_master("getParamNames", "/test"))

    def has_types_of_tests(self) -> bool:
        """Return whether it knows types of topics that are no more: until they are advertised again, tools such as
        rostopic take those."""
        return any(topic not in OF_ONE_TYPE for topic, _ in self._ask_master("getTopicTypes", "/test"))

    def nodes(self) -> set[str]:
        return nodes_of(self.state())

    def pid_of(self, node: str) -> int:
        """Return the process of a node."""
        api: Any = xmlrpc.client.ServerProxy(self._ask_master("lookupNode", "/test", node))
        return int(api.getPid("/test")[2])

    def set_param(self, name: str, value: object) -> None:
        self._ask_master("setParam", "/test", name, value)

    def run(self, *command: str) -> str:
        """Return the output of a ROS tool that ends by itself, such as `rosnode list`."""
        return subprocess.run(
            command, env=self.env, text=True, stdout=subprocess.PIPE, timeout=2 * DEADLINE, check=True
        ).stdout

    def echo(self, topic: str, *options: str, field: str = "", count: int = 1) -> str:
        """Return what `rostopic echo` shows of the next messages. It starts when the topic is published: before that,
        rostopic takes the type that the topic had last, and waits in vain for messages of it."""
        wait_until(lambda: topic in self.state()["publishers"], f"{topic} to be advertised")
        return self.run("rostopic", "echo", "-n", str(count), *options, topic + field)

    @contextlib.contextmanager
    def publishing(self, topic: str, message_type: str, *message: str) -> Iterator[None]:
        """Publish a message once, latched during the block: `rostopic pub -1` ends after 3 s, when a subscriber may not
        have connected yet."""
        process = start(["rostopic", "pub", topic, message_type, *message], self.env, stdout=subprocess.DEVNULL)
        try:
            yield
        finally:
            stop(process)

    def pause(self) -> None:
        """Make the master hang, like an overloaded machine: it accepts connections but does not answer."""
        os.kill(self._master_pid, signal.SIGSTOP)

    def resume(self) -> None:
        os.kill(self._master_pid, signal.SIGCONT)

    def kill(self) -> None:
        """Kill the master."""
        os.kill(self._master_pid, signal.SIGKILL)
        stop(self.process)


class RestartableCore:
    """A roscore that can be killed and started again on its port."""

    def __init__(self, directory: Path) -> None:
        self._directory = directory
        self.core = RosCore(directory, free_port())

    def kill(self) -> None:
        self.core.kill()

    def start(self) -> None:
        self.core = RosCore(self._directory, self.core.port)


@dataclass
class _Kept:
    """The roscore of the last test: starting one takes longer than most tests."""

    core: RosCore
    file: Path
    """The test's: those in one file give a topic one type."""


_kept: list[_Kept] = []


def _kept_for(file: Path) -> RosCore | None:
    if not _kept:
        return None
    last = _kept.pop()
    if last.file == file or not last.core.has_types_of_tests():
        return last.core
    stop(last.core.process)
    return None


@pytest.fixture
def roscore(request: pytest.FixtureRequest, tmp_path: Path) -> Iterator[RosCore]:
    """Yield a roscore without nodes, parameters and services of tests, and without topics of other files' tests."""
    log = tmp_path / "roslog"
    core = _kept_for(request.path) or RosCore(log)
    core.env = ros_environment(core.port, log)
    yield core
    core.resume()
    core.forget_ended_nodes()
    if core.is_as_new():
        _kept.append(_Kept(core, request.path))
    else:
        stop(core.process)


def pytest_sessionfinish() -> None:
    while _kept:
        stop(_kept.pop().core.process)
