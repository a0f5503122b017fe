# SPDX-License-Identifier: BSD-3-Clause
"""A master that dies and returns, loses the node, or hangs."""

import os
import signal
import time
import xmlrpc.client
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import pytest

from bridge_probe import Probe
from ros_support import DEADLINE, RestartableCore, RosCore, free_port, ros_environment, stop, wait_until

NAME = "/sim_ros_interface"
RETURN = 1.0
"""Seconds within which everything must work again once a new master answers."""
OWN_SERVICES = {f"{NAME}/{name}" for name in ("get_loggers", "set_logger_level", "pause", "unpause", "paint")}
KEPT_PUBLISHERS = {"/rosout", "/clock", "/out", "/map"}


@contextmanager
def restartable_core(directory: Path) -> Iterator[RestartableCore]:
    restartable = RestartableCore(directory)
    try:
        yield restartable
    finally:
        stop(restartable.core.process)


def own(core: RosCore, kind: str) -> set[str]:
    return {name for name, nodes in core.state()[kind].items() if NAME in nodes}


def is_back(core: RosCore) -> bool:
    return (
        own(core, "publishers") >= KEPT_PUBLISHERS
        and own(core, "subscribers") >= {"/in"}
        and own(core, "services") >= OWN_SERVICES
    )


def make_endpoints(probe: Probe) -> tuple[str, str]:
    """Make a publisher of /out, a subscriber of /in, a latched /map and a service /paint."""
    publisher = probe.ask("advertise", "/out", "float")
    probe.ask("publish", probe.ask("advertise", "/map", "float", "latch"), 4.0)
    probe.ask("serve", "paint", "setbool")
    return publisher, probe.ask("subscribe", "/in", "float")


def check_delivery(core: RosCore, probe: Probe, publisher: str, subscriber: str, name: str) -> None:
    """Check that a node that is new to the master exchanges messages with `probe`."""
    with Probe(core.env, f"__name:={name}") as peer:
        received, latched = peer.ask("subscribe", "/out", "float"), peer.ask("subscribe", "/map", "float")
        logged = peer.ask("subscribe", "/rosout", "log")
        outgoing = peer.ask("advertise", "/in", "float")
        peer.wait_for(lambda: peer.ask("wants", outgoing) == "yes", "the bridge to connect")
        probe.wait_for(lambda: probe.ask("wants", publisher) == "yes", "the bridge to be connected")
        before = len(probe.messages(subscriber))
        peer.ask("publish", outgoing, 2.0)
        probe.ask("publish", publisher, 3.0)
        peer.wait_for(lambda: peer.messages(received) == ["3.000000"], "the bridge's message")
        peer.wait_for(lambda: peer.messages(latched) == ["4.000000"], "the latched message")
        probe.wait_for(lambda: len(probe.messages(subscriber)) == before + 1, "the peer's message")

        def log_arrives() -> bool:
            probe.ask("log", f"to_{name}")
            return f"to_{name}" in peer.messages(logged)

        peer.wait_for(log_arrives, "the log's messages")
        answer = peer.ask("call", peer.ask("client", f"{NAME}/paint", "setbool"), 5, 1)
        assert answer.startswith("yes of")


@pytest.mark.parametrize("times", [3, pytest.param(20, marks=pytest.mark.long)])
def test_everything_is_back_after_the_master_was_killed(tmp_path: Path, times: int) -> None:
    with restartable_core(tmp_path) as restartable, Probe(restartable.core.env) as probe:
        publisher, subscriber = make_endpoints(probe)
        for round_number in range(times):
            restartable.kill()
            restartable.start()
            wait_until(lambda: is_back(restartable.core), "the registrations", RETURN)
            check_delivery(restartable.core, probe, publisher, subscriber, f"peer{round_number}")


def test_connections_outlive_the_master(tmp_path: Path) -> None:
    """Other nodes, which do not register again, stay connected when the bridge registers again."""
    with (
        restartable_core(tmp_path) as restartable,
        Probe(restartable.core.env) as probe,
        Probe(restartable.core.env, "__name:=peer") as peer,
    ):
        publisher, subscriber = make_endpoints(probe)
        received, outgoing = peer.ask("subscribe", "/out", "float"), peer.ask("advertise", "/in", "float")
        peer.wait_for(lambda: peer.ask("wants", outgoing) == "yes", "the bridge to connect")
        probe.wait_for(lambda: probe.ask("wants", publisher) == "yes", "the peer to connect")
        both = probe.ask("subscribe", "/out", "float")
        wait_until(lambda: len(restartable.core.state()["subscribers"].get("/out", [])) == 2, "the subscribers")
        os.kill(peer.process.pid, signal.SIGSTOP)  # it must not register again by itself
        restartable.kill()
        restartable.start()
        wait_until(lambda: is_back(restartable.core), "the registrations", RETURN)
        time.sleep(0.5)  # long enough for anything that would cut the connection
        os.kill(peer.process.pid, signal.SIGCONT)
        peer.ask("publish", outgoing, 1.0)
        probe.wait_for(lambda: probe.messages(subscriber) == ["1.000000"], "the peer's message")
        probe.ask("publish", publisher, 2.0)
        probe.wait_for(lambda: probe.messages(both) == ["2.000000"], "its own message")
        peer.wait_for(lambda: peer.messages(received) == ["2.000000"], "the bridge's message")


def test_endpoints_of_a_time_without_master_end_up_right(tmp_path: Path) -> None:
    with restartable_core(tmp_path) as restartable, Probe(restartable.core.env) as probe:
        gone = [probe.ask("advertise", "/gone", "float"), probe.ask("subscribe", "/gone", "float")]
        gone_server = probe.ask("serve", "/gone", "setbool")
        wait_until(lambda: "/gone" in own(restartable.core, "services"), "the endpoints")
        restartable.kill()
        probe.wait_for(lambda: probe.ask("connected") == "no", "the loss to be noticed")
        probe.ask("shutdown_publisher", gone[0])
        probe.ask("shutdown_subscriber", gone[1])
        probe.ask("shutdown_server", gone_server)
        probe.ask("advertise", "/new", "float")
        probe.ask("subscribe", "/new", "float")
        probe.ask("serve", "/new", "setbool")
        probe.ask("shutdown_publisher", probe.ask("advertise", "/brief", "float"))
        restartable.start()
        kinds = ("publishers", "subscribers", "services")

        def is_right() -> bool:
            names = [own(restartable.core, kind) for kind in kinds]
            return all("/new" in known and not known & {"/gone", "/brief"} for known in names)

        wait_until(is_right, "the endpoints", RETURN)
        assert probe.ask("connected") == "yes"


def test_node_that_the_master_forgot_comes_back(roscore: RosCore) -> None:
    with Probe(roscore.env) as probe:
        publisher, subscriber = make_endpoints(probe)
        wait_until(lambda: is_back(roscore), "the registrations")
        os.kill(probe.process.pid, signal.SIGSTOP)  # it would come back while the master still forgets
        forget(roscore, NAME)
        os.kill(probe.process.pid, signal.SIGCONT)
        wait_until(lambda: is_back(roscore), "the registrations to come back")
        check_delivery(roscore, probe, publisher, subscriber, "peer")


def forget(core: RosCore, node: str) -> None:
    """Do what `rosnode cleanup` does to a node that it considers dead."""
    master: Any = xmlrpc.client.ServerProxy(core.env["ROS_MASTER_URI"])
    uri = master.lookupNode("/test", node)[2]
    for topic in own(core, "publishers"):
        master.unregisterPublisher(node, topic, uri)
    for topic in own(core, "subscribers"):
        master.unregisterSubscriber(node, topic, uri)
    for service in own(core, "services"):
        master.unregisterService(node, service, master.lookupService("/test", service)[2])
    assert node not in core.nodes()


def test_use_sim_time_of_the_new_master_holds(tmp_path: Path) -> None:
    with restartable_core(tmp_path) as restartable, Probe(restartable.core.env) as probe:
        assert probe.ask("now") != "0 0"
        for simulated in (True, False):
            restartable.kill()
            probe.wait_for(lambda: probe.ask("connected") == "no", "the loss to be noticed")
            os.kill(probe.process.pid, signal.SIGSTOP)  # until the parameter is set
            restartable.start()
            restartable.core.set_param("/use_sim_time", simulated)
            os.kill(probe.process.pid, signal.SIGCONT)
            probe.wait_for(lambda: probe.ask("connected") == "yes", "the new master")
            probe.ask("clock", 12.5)
            assert (probe.ask("now") == "12 500000000") == simulated


def test_no_call_of_a_pass_waits_for_a_hanging_master(roscore: RosCore) -> None:
    with Probe(roscore.env) as probe:
        make_endpoints(probe)
        wait_until(lambda: is_back(roscore), "the registrations")
        roscore.pause()
        time.sleep(0.5)  # until a call to the master is in progress
        assert float(probe.ask("longest", "/busy")) < 50  # ms; far more than any call, far less than any timeout


def test_messages_flow_while_the_master_hangs(roscore: RosCore) -> None:
    with Probe(roscore.env) as probe, Probe(roscore.env, "__name:=peer") as peer:
        publisher, gone = probe.ask("advertise", "/out", "float"), probe.ask("advertise", "/gone", "float")
        received = peer.ask("subscribe", "/out", "float")
        probe.wait_for(lambda: probe.ask("wants", publisher) == "yes", "the peer to connect")
        wait_until(lambda: "/gone" in own(roscore, "publishers"), "the publisher")
        roscore.pause()
        time.sleep(0.5)
        probe.ask("shutdown_publisher", gone)  # roscpp would hold the lock that delivery needs
        time.sleep(0.5)
        probe.ask("publish", publisher, 1.0)
        peer.wait_for(lambda: peer.messages(received) == ["1.000000"], "the message")


def _times_of(probe: Probe, text: str, count: int) -> list[float]:
    """Return when lines with a string were logged, by time.monotonic."""
    times: list[float] = []

    def is_logged_again() -> bool:
        if sum(text in line for line in probe.errors) > len(times):
            times.append(time.monotonic())
        return len(times) == count

    probe.wait_for(is_logged_again, f"'{text}', {count} times", timeout=2 * DEADLINE)
    return times


def test_a_missing_master_is_reported_every_ten_seconds(tmp_path: Path) -> None:
    port = free_port()
    with Probe(ros_environment(port, tmp_path)) as probe:
        times = _times_of(probe, f"no ROS master at http://localhost:{port}; start one with 'roscore'", 2)
        assert 6.0 < times[1] - times[0] < 20.0  # on a busy machine each is seen late


def test_a_lost_master_is_reported_until_it_is_back(tmp_path: Path) -> None:
    with restartable_core(tmp_path) as restartable, Probe(restartable.core.env) as probe:
        probe.wait_for(lambda: probe.ask("connected") == "yes", "the connection")
        restartable.core.pause()  # it hangs
        uri = restartable.core.env["ROS_MASTER_URI"]
        times = _times_of(probe, f"the ROS master at {uri} does not answer", 2)
        assert 6.0 < times[1] - times[0] < 20.0
        restartable.kill()
        restartable.start()
        wait_until(lambda: NAME in restartable.core.nodes(), "the node")
        reports = sum("does not answer" in line for line in probe.errors)
        time.sleep(1.0)
        assert sum("does not answer" in line for line in probe.errors) == reports
