# SPDX-License-Identifier: BSD-3-Clause
"""Messages between the bridge and ordinary ROS programs."""

import subprocess
from collections.abc import Iterator
from contextlib import contextmanager
from functools import partial
from pathlib import Path

from bridge_probe import Probe
from ros_support import RosCore, start, stop, wait_until


@contextmanager
def rostopic_echo(core: RosCore, topic: str, log: Path) -> Iterator[None]:
    """Write `rostopic echo` of an advertised topic to a file, from its subscription until the end of the block."""
    wait_until(lambda: topic in core.state()["publishers"], f"{topic} to be advertised")  # rostopic warns otherwise
    with log.open("w") as file:
        echo = start(["rostopic", "echo", topic], core.env, stdout=file, stderr=subprocess.STDOUT)
        try:
            wait_until(lambda: topic in core.state()["subscribers"], f"rostopic echo {topic} to subscribe")
            yield
        finally:
            stop(echo)


def is_registered(core: RosCore, kind: str, topic: str) -> bool:
    return "/sim_ros_interface" in core.state()[kind].get(topic, [])


def has_got(probe: Probe, subscriber: str, messages: list[str]) -> bool:
    return probe.messages(subscriber) == messages


def test_rostopic_echo_prints_what_is_published(roscore: RosCore, tmp_path: Path) -> None:
    log = tmp_path / "echo"
    with Probe(roscore.env) as probe:
        publisher = probe.ask("advertise", "/speed", "float")
        with rostopic_echo(roscore, "/speed", log):
            probe.wait_for(lambda: probe.ask("wants", publisher) == "yes", "rostopic to connect")
            probe.ask("publish", publisher, 0.5)
            probe.ask("publish", publisher, -2.25)
            wait_until(lambda: log.read_text() == "data: 0.5\n---\ndata: -2.25\n---\n", "both messages")


def test_large_message_arrives_whole(roscore: RosCore, tmp_path: Path) -> None:
    text = "x" * 900_000
    log = tmp_path / "echo"
    with Probe(roscore.env) as probe:
        publisher = probe.ask("advertise", "/text", "string")
        with rostopic_echo(roscore, "/text", log):
            probe.wait_for(lambda: probe.ask("wants", publisher) == "yes", "rostopic to connect")
            probe.ask("publish", publisher, text)
            wait_until(lambda: log.read_text() == f'data: "{text}"\n---\n', "the message")


def test_message_without_bytes_arrives(roscore: RosCore, tmp_path: Path) -> None:
    log = tmp_path / "echo"
    with Probe(roscore.env) as probe:
        publisher = probe.ask("advertise", "/tick", "empty")
        with rostopic_echo(roscore, "/tick", log):
            probe.wait_for(lambda: probe.ask("wants", publisher) == "yes", "rostopic to connect")
            probe.ask("publish", publisher)
            wait_until(lambda: log.read_text().split() == ["---"], "the message")


def test_header_gets_the_sequence_number(roscore: RosCore, tmp_path: Path) -> None:
    log = tmp_path / "echo"
    with Probe(roscore.env) as probe:
        publisher = probe.ask("advertise", "/temperature", "temperature")
        with rostopic_echo(roscore, "/temperature", log):
            probe.wait_for(lambda: probe.ask("wants", publisher) == "yes", "rostopic to connect")
            probe.ask("publish", publisher, 20.0)
            probe.ask("publish", publisher, 21.0)
            wait_until(lambda: "seq: 1\n" in log.read_text() and "temperature: 21.0" in log.read_text(), "the second")


def test_message_that_ends_within_its_header_is_refused(roscore: RosCore) -> None:
    with Probe(roscore.env) as probe:
        publisher = probe.ask("advertise", "/temperature", "temperature", "latch")
        answer = probe.ask("publish", publisher, "truncated")
        assert answer == "! message of type sensor_msgs/Temperature ends within its header"


def test_latched_message_reaches_a_late_subscriber(roscore: RosCore, tmp_path: Path) -> None:
    log = tmp_path / "echo"
    with Probe(roscore.env) as probe:
        publisher = probe.ask("advertise", "/map", "float", "latch")
        probe.wait_for(lambda: is_registered(roscore, "publishers", "/map"), "the publisher")
        probe.ask("publish", publisher, 1.0)
        probe.ask("publish", publisher, 2.0)
        with rostopic_echo(roscore, "/map", log):
            wait_until(lambda: log.read_text() == "data: 2.0\n---\n", "the last message")


def test_second_latching_publisher_of_a_topic_reaches_those_connected_to_the_first(roscore: RosCore) -> None:
    with Probe(roscore.env) as probe:
        subscriber = probe.ask("subscribe", "/map", "float")
        probe.ask("publish", probe.ask("advertise", "/map", "float", "latch"), 1.0)
        probe.wait_for(lambda: probe.messages(subscriber) == ["1.000000"], "the first's")
        probe.ask("publish", probe.ask("advertise", "/map", "float", "latch"), 2.0)
        probe.wait_for(lambda: probe.messages(subscriber) == ["1.000000", "2.000000"], "the second's")


def test_without_latching_only_a_connected_publisher_wants_messages(roscore: RosCore) -> None:
    with Probe(roscore.env) as probe:
        assert probe.ask("wants", probe.ask("advertise", "/a", "float")) == "no"
        assert probe.ask("wants", probe.ask("advertise", "/b", "float", "latch")) == "yes"


def test_subscriber_gets_what_rostopic_pub_sends(roscore: RosCore) -> None:
    with Probe(roscore.env) as probe:
        subscriber = probe.ask("subscribe", "/steering", "float")
        probe.wait_for(lambda: is_registered(roscore, "subscribers", "/steering"), "the subscriber")
        with roscore.publishing("/steering", "std_msgs/Float32", "--", "-1.5"):
            probe.wait_for(lambda: probe.messages(subscriber) == ["-1.500000"], "the message")


def test_two_subscribers_of_a_topic_get_each_message(roscore: RosCore) -> None:
    with Probe(roscore.env) as probe:
        subscribers = [probe.ask("subscribe", "/name", "string") for _ in range(2)]
        probe.wait_for(lambda: is_registered(roscore, "subscribers", "/name"), "the subscribers")
        for received in (["one"], ["one", "two"]):
            with roscore.publishing("/name", "std_msgs/String", received[-1]):
                for subscriber in subscribers:
                    probe.wait_for(partial(has_got, probe, subscriber, received), f"subscriber {subscriber}")


def test_own_publisher_reaches_own_subscriber(roscore: RosCore) -> None:
    with Probe(roscore.env) as probe:
        subscriber = probe.ask("subscribe", "/loop", "string")
        publisher = probe.ask("advertise", "/loop", "string")
        probe.wait_for(lambda: probe.ask("wants", publisher) == "yes", "the connection to itself")
        probe.ask("publish", publisher, "hello")
        probe.wait_for(lambda: probe.messages(subscriber) == ["hello"], "the message")


def test_callback_that_shuts_its_subscriber_down_is_not_called_again(roscore: RosCore) -> None:
    with Probe(roscore.env) as probe:
        once = probe.ask("subscribe", "/loop", "string", "once")
        always = probe.ask("subscribe", "/loop", "string")
        publisher = probe.ask("advertise", "/loop", "string")
        probe.wait_for(lambda: probe.ask("wants", publisher) == "yes", "the connection to itself")
        probe.ask("publish", publisher, "one")
        probe.ask("publish", publisher, "two")
        probe.wait_for(lambda: probe.messages(always) == ["one", "two"], "the messages")
        assert probe.messages(once) == ["one"]


def test_drain_serves_the_others_before_it_throws(roscore: RosCore) -> None:
    with Probe(roscore.env) as probe:
        thrower = probe.ask("subscribe", "/loop", "string", "throw")
        other = probe.ask("subscribe", "/loop", "string")
        publisher = probe.ask("advertise", "/loop", "string")
        probe.wait_for(lambda: probe.ask("wants", publisher) == "yes", "the connection to itself")
        probe.ask("publish", publisher, "hello", other)  # returns when both have it in their queue
        probe.wait_for(lambda: f"process_input threw subscriber {thrower}" in probe.events, "the error")
        assert probe.messages(other) == ["hello"]


def test_shut_down_endpoints_leave_the_master(roscore: RosCore) -> None:
    with Probe(roscore.env) as probe:
        publisher = probe.ask("advertise", "/out", "float")
        subscriber = probe.ask("subscribe", "/in", "float")
        probe.wait_for(lambda: is_registered(roscore, "publishers", "/out"), "the publisher")
        probe.wait_for(lambda: is_registered(roscore, "subscribers", "/in"), "the subscriber")
        probe.ask("shutdown_publisher", publisher)
        probe.ask("shutdown_subscriber", subscriber)
        probe.wait_for(lambda: not is_registered(roscore, "publishers", "/out"), "the publisher to go")
        probe.wait_for(lambda: not is_registered(roscore, "subscribers", "/in"), "the subscriber to go")


def test_topic_can_change_its_type_after_shutdown(roscore: RosCore) -> None:
    with Probe(roscore.env) as probe:
        probe.ask("shutdown_publisher", probe.ask("advertise", "/x", "float"))
        probe.ask("advertise", "/x", "string")
        wait_until(lambda: "std_msgs/String" in roscore.run("rostopic", "list", "-v"), "the new type")
