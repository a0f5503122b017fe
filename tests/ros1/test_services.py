# SPDX-License-Identifier: BSD-3-Clause
"""Services advertised and called by the bridge."""

import signal
import socket
import time
import xmlrpc.client
from collections.abc import Iterator
from concurrent.futures import ThreadPoolExecutor
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import pytest

from bridge_probe import Probe
from ros_support import SUPPORT, RosCore, free_port, ros_environment, start, stop, wait_until

OTHER = "__name:=other"
BOUND = 7.0
"""Seconds within which a bridge must end in any state, plus extra time for a process on a busy machine."""


def wait_for_service(core: RosCore, name: str) -> None:
    wait_until(lambda: name in core.state()["services"], f"service {name}")


@contextmanager
def silent_server(core: RosCore, name: str) -> Iterator[socket.socket]:
    """A registered service that accepts connections, but never responds."""
    with socket.create_server(("localhost", 0)) as server:
        master: Any = xmlrpc.client.ServerProxy(core.env["ROS_MASTER_URI"])
        address = f"rosrpc://localhost:{server.getsockname()[1]}"
        master.registerService("/silent", name, address, "http://localhost:1")
        yield server


@contextmanager
def painter(core: RosCore) -> Iterator[None]:
    process = start(["/usr/bin/python3", str(SUPPORT / "rospy_server.py")], core.env)
    try:
        wait_for_service(core, "/paint")
        yield
    finally:
        stop(process)


def test_rosservice_gets_the_answer_of_a_callback(roscore: RosCore) -> None:
    with Probe(roscore.env) as probe:
        server = probe.ask("serve", "/paint", "setbool")
        wait_for_service(roscore, "/paint")
        answer = roscore.run("rosservice", "call", "/paint", "true")
        assert f'success: True\nmessage: "of {server}"' in answer
        probe.wait_for(lambda: f"request {server} 1" in probe.events, "the callback's line")


def test_rosservice_knows_the_type(roscore: RosCore) -> None:
    with Probe(roscore.env) as probe:
        probe.ask("serve", "/paint", "setbool")
        wait_for_service(roscore, "/paint")
        assert roscore.run("rosservice", "type", "/paint") == "std_srvs/SetBool\n"


def test_relative_service_name_is_below_the_node(roscore: RosCore) -> None:
    with Probe(roscore.env) as probe:
        probe.ask("serve", "paint", "setbool")
        wait_for_service(roscore, "/sim_ros_interface/paint")


def test_call_of_a_rospy_service_brings_its_response(roscore: RosCore) -> None:
    with Probe(roscore.env) as probe, painter(roscore):
        client = probe.ask("client", "/paint", "setbool")
        assert probe.ask("call", client, 5, 1) == "yes painted"


def test_error_text_of_a_rospy_service_is_passed_on(roscore: RosCore) -> None:
    with Probe(roscore.env) as probe, painter(roscore):
        client = probe.ask("client", "/paint", "setbool")
        answer = probe.ask("call", client, 5, 0)
        assert answer.startswith("! service '/paint' failed: ")
        assert "no brush" in answer


def test_call_of_another_bridge(roscore: RosCore) -> None:
    with Probe(roscore.env) as probe, Probe(roscore.env, OTHER) as other:
        server = other.ask("serve", "/paint", "setbool")
        wait_for_service(roscore, "/paint")
        client = probe.ask("client", "/paint", "setbool")
        for value, word in ((1, "yes"), (0, "no"), (1, "yes")):
            assert probe.ask("call", client, 5, value) == f"{word} of {server}"


def test_caller_gets_the_text_of_a_callback_that_refuses(roscore: RosCore) -> None:
    with Probe(roscore.env) as probe, Probe(roscore.env, OTHER) as other:
        other.ask("serve", "/paint", "setbool", "fail")
        wait_for_service(roscore, "/paint")
        client = probe.ask("client", "/paint", "setbool")
        assert probe.ask("call", client, 5, 1) == "! service '/paint' failed: out of paint"
        assert not [event for event in other.events if event.startswith("process_input threw")]


def test_caller_and_drain_get_what_a_callback_throws(roscore: RosCore) -> None:
    with Probe(roscore.env) as probe, Probe(roscore.env, OTHER) as other:
        server = other.ask("serve", "/paint", "setbool", "throw")
        wait_for_service(roscore, "/paint")
        client = probe.ask("client", "/paint", "setbool")
        assert probe.ask("call", client, 5, 1) == f"! service '/paint' failed: server {server}"
        other.wait_for(lambda: f"process_input threw server {server}" in other.events, "the error")


def test_call_of_an_own_service(roscore: RosCore) -> None:
    with Probe(roscore.env) as probe:
        client = probe.ask("client", "/paint", "setbool")
        server = probe.ask("serve", "/paint", "setbool")
        assert probe.ask("call", client, 5, 1) == f"yes of {server}"


def test_call_of_an_own_service_needs_no_master(tmp_path: Path) -> None:
    with Probe(ros_environment(free_port(), tmp_path)) as probe:
        server = probe.ask("serve", "/paint", "setbool")
        assert probe.ask("call", probe.ask("client", "/paint", "setbool"), 5, 0) == f"no of {server}"


def test_own_services_are_answered_while_another_node_is_called(roscore: RosCore) -> None:
    """This node calls the other's service, which calls back before it answers."""
    with Probe(roscore.env) as probe, Probe(roscore.env, OTHER) as other:
        back = probe.ask("serve", "/back", "trigger")
        wait_for_service(roscore, "/back")
        other.ask("serve", "/forth", "trigger", "call", other.ask("client", "/back", "trigger"))
        wait_for_service(roscore, "/forth")
        assert probe.ask("call", probe.ask("client", "/forth", "trigger"), 5) == f"no of {back}"


def test_services_that_call_in_a_circle_are_stopped(roscore: RosCore) -> None:
    with Probe(roscore.env) as probe, Probe(roscore.env, OTHER) as other:
        there = probe.ask("client", "/there", "trigger")
        here_server = probe.ask("serve", "/here", "trigger", "call", there)
        other.ask("serve", "/there", "trigger", "call", other.ask("client", "/here", "trigger"))
        wait_for_service(roscore, "/here")
        wait_for_service(roscore, "/there")
        answer = probe.ask("call", there, 5)
        assert answer.endswith("16 nested service calls: check for services that call each other")
        assert probe.events.count(f"request {here_server} 0") > 1  # it answered while it was being called


def test_messages_wait_while_a_service_is_called(roscore: RosCore) -> None:
    with Probe(roscore.env) as probe, Probe(roscore.env, OTHER) as other:
        other.ask("serve", "/slow", "trigger", "sleep")
        wait_for_service(roscore, "/slow")
        subscriber = probe.ask("subscribe", "/loop", "string")
        publisher = probe.ask("advertise", "/loop", "string")
        probe.wait_for(lambda: probe.ask("wants", publisher) == "yes", "the connection to itself")
        probe.ask("publish", publisher, "hello")
        probe.wait_for(lambda: probe.messages(subscriber) == ["hello"], "the message")
        assert probe.ask("call", probe.ask("client", "/slow", "trigger"), 5).startswith("no of")


def test_unknown_service_is_named_with_those_alike(roscore: RosCore) -> None:
    with Probe(roscore.env) as probe, Probe(roscore.env, OTHER) as other:
        other.ask("serve", "/paint", "setbool")
        wait_for_service(roscore, "/paint")
        client = probe.ask("client", "/pant", "setbool")
        assert probe.ask("call", client, 5, 1) == "! no service '/pant'; did you mean /paint?"


def test_type_of_another_service_is_named(roscore: RosCore) -> None:
    with Probe(roscore.env) as probe, Probe(roscore.env, OTHER) as other:
        other.ask("serve", "/paint", "setbool")
        wait_for_service(roscore, "/paint")
        client = probe.ask("client", "/paint", "trigger")
        assert probe.ask("call", client, 5) == "! service '/paint' is of type std_srvs/SetBool, not std_srvs/Trigger"


def test_type_of_an_own_service_is_named(roscore: RosCore) -> None:
    with Probe(roscore.env) as probe:
        probe.ask("serve", "/paint", "setbool")
        client = probe.ask("client", "/paint", "trigger")
        assert probe.ask("call", client, 5) == "! service '/paint' is of type std_srvs/SetBool, not std_srvs/Trigger"


def test_call_without_a_master_reports_that(tmp_path: Path) -> None:
    port = free_port()
    with Probe(ros_environment(port, tmp_path)) as probe:
        client = probe.ask("client", "/paint", "setbool")
        assert probe.ask("call", client, 5, 1) == f"! no ROS master at http://localhost:{port}"


def test_call_of_a_server_that_never_answers_times_out(roscore: RosCore) -> None:
    with Probe(roscore.env) as probe, silent_server(roscore, "/paint"):
        client = probe.ask("client", "/paint", "setbool")
        begin = time.monotonic()
        assert probe.ask("call", client, 1.5, 1) == "! service '/paint' did not answer within 1.5 s"
        assert time.monotonic() - begin > 1.5


def test_call_that_timed_out_while_the_process_was_stopped_is_no_fault_of_the_master(roscore: RosCore) -> None:
    """Its two threads continue in any order."""
    with Probe(roscore.env) as probe, silent_server(roscore, "/paint"):
        client = probe.ask("client", "/paint", "setbool")
        for _ in range(5):
            with ThreadPoolExecutor() as beside:
                answer = beside.submit(probe.ask, "call", client, 0.5, 1)
                time.sleep(0.3)
                probe.process.send_signal(signal.SIGSTOP)
                time.sleep(0.5)
                probe.process.send_signal(signal.SIGCONT)
                assert answer.result() == "! service '/paint' did not answer within 0.5 s"


def test_call_times_out_while_the_master_hangs(roscore: RosCore) -> None:
    with Probe(roscore.env) as probe:
        client = probe.ask("client", "/paint", "setbool")
        roscore.pause()
        for _ in range(20):  # more than the largest number of remaining call threads
            assert "the ROS master does not answer" in probe.ask("call", client, 0.05, 1)
        assert probe.terminate() < BOUND


def test_server_that_closes_the_connection_is_reported(roscore: RosCore) -> None:
    with Probe(roscore.env) as probe, silent_server(roscore, "/paint") as server:
        port = server.getsockname()[1]
        server.close()
        answer = probe.ask("call", probe.ask("client", "/paint", "setbool"), 5, 1)
        assert answer == f"! connection to service '/paint' at localhost:{port} failed: Connection refused"


def test_call_is_given_up_when_the_process_ends(roscore: RosCore) -> None:
    with Probe(roscore.env) as probe, silent_server(roscore, "/paint"):
        client = probe.ask("client", "/paint", "setbool")
        probe.send("call", client, 60, 1)
        time.sleep(0.3)  # until the call is in progress
        assert probe.terminate() < BOUND
        assert probe.process.returncode == 0


def test_wait_for_service_ends_when_it_appears(roscore: RosCore) -> None:
    with Probe(roscore.env) as probe, Probe(roscore.env, OTHER) as other:
        assert probe.ask("wait_for_service", "/paint", 0.2) == "no"
        assert probe.ask("wait_for_service", "/paint", 0) == "no"
        other.ask("serve", "/paint", "setbool")
        assert probe.ask("wait_for_service", "/paint", 10) == "yes"
        assert probe.ask("wait_for_service", "/paint", 0) == "yes"


def test_wait_for_service_is_not_fooled_by_a_dead_server(roscore: RosCore) -> None:
    with Probe(roscore.env) as probe, silent_server(roscore, "/paint") as server:
        assert probe.ask("wait_for_service", "/paint", 0) == "yes"
        server.close()
        assert probe.ask("wait_for_service", "/paint", 0.2) == "no"


def test_shut_down_service_leaves_the_master(roscore: RosCore) -> None:
    with Probe(roscore.env) as probe:
        server = probe.ask("serve", "/paint", "setbool")
        wait_for_service(roscore, "/paint")
        probe.ask("shutdown_server", server)
        wait_until(lambda: "/paint" not in roscore.state()["services"], "the service to go")


def test_name_of_a_shut_down_service_can_be_used_again(roscore: RosCore) -> None:
    with Probe(roscore.env) as probe:
        probe.ask("shutdown_server", probe.ask("serve", "/paint", "setbool"))
        second = probe.ask("serve", "/paint", "trigger")
        wait_for_service(roscore, "/paint")
        assert f'message: "of {second}"' in roscore.run("rosservice", "call", "/paint")


def test_callback_may_shut_its_own_service_down(roscore: RosCore) -> None:
    with Probe(roscore.env) as probe:
        server = probe.ask("serve", "/paint", "setbool", "close")
        client = probe.ask("client", "/paint", "setbool")
        assert probe.ask("call", client, 5, 1) == f"yes of {server}"
        wait_until(lambda: "/paint" not in roscore.state()["services"], "the service to go")


@pytest.mark.parametrize(
    ("command", "kind"),
    [("call 7 1", "server or client"), ("shutdown_server 7", "server"), ("shutdown_client 7", "client")],
)
def test_unknown_service_handle_is_named(tmp_path: Path, command: str, kind: str) -> None:
    with Probe(ros_environment(free_port(), tmp_path)) as probe:
        assert probe.ask(command) == f"! invalid object handle 7: no such service {kind}, or it was shut down"


def test_second_service_of_a_name_is_refused(tmp_path: Path) -> None:
    with Probe(ros_environment(free_port(), tmp_path)) as probe:
        probe.ask("serve", "/paint", "setbool")
        assert probe.ask("serve", "/paint", "trigger") == "! service '/paint' is already advertised by this node"


def test_timeout_must_be_positive(tmp_path: Path) -> None:
    with Probe(ros_environment(free_port(), tmp_path)) as probe:
        client = probe.ask("client", "/paint", "setbool")
        assert probe.ask("call", client, 0, 1) == "! the timeout of a service call must be positive"
