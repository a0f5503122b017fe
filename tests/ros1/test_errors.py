# SPDX-License-Identifier: BSD-3-Clause
"""Error messages of the bridge to script authors. None of these tests needs a master."""

from collections.abc import Iterator
from pathlib import Path

import pytest

from bridge_probe import Probe
from ros_support import free_port, ros_environment


@pytest.fixture
def probe(tmp_path: Path) -> Iterator[Probe]:
    with Probe(ros_environment(free_port(), tmp_path)) as running:
        yield running


@pytest.mark.parametrize(
    ("command", "kind"),
    [
        ("publish 7 1.0", "publisher or subscriber"),
        ("wants 7", "publisher"),
        ("shutdown_publisher 7", "publisher"),
        ("shutdown_subscriber 7", "subscriber"),
    ],
)
def test_unknown_handle_is_named(probe: Probe, command: str, kind: str) -> None:
    assert probe.ask(command) == f"! invalid object handle 7: no such {kind}, or it was shut down"


def test_handle_is_invalid_after_shutdown(probe: Probe) -> None:
    publisher = probe.ask("advertise", "/x", "float")
    probe.ask("shutdown_publisher", publisher)
    assert "invalid object handle" in probe.ask("publish", publisher, 1.0)


def test_publisher_is_no_subscriber(probe: Probe) -> None:
    publisher = probe.ask("advertise", "/x", "float")
    assert "no such subscriber" in probe.ask("shutdown_subscriber", publisher)


@pytest.mark.parametrize("topic", ["a-b", "1a", "/a~b", "/"])
def test_unusable_topic_name_is_refused(probe: Probe, topic: str) -> None:
    assert probe.ask("advertise", topic, "float").startswith(f"! invalid topic name '{topic}': ")
    assert probe.ask("subscribe", topic, "float").startswith(f"! invalid topic name '{topic}': ")


def test_second_type_on_a_topic_is_refused(probe: Probe) -> None:
    probe.ask("advertise", "/x", "float")
    assert probe.ask("advertise", "/x", "string") == (
        "! topic '/x' is already advertised here as std_msgs/Float32, not std_msgs/String"
    )
    assert "already advertised here as std_msgs/Float32" in probe.ask("subscribe", "/x", "string")
    probe.ask("subscribe", "/y", "float")
    for again in ("subscribe", "advertise"):
        assert "already subscribed here as std_msgs/Float32" in probe.ask(again, "/y", "string")


@pytest.mark.parametrize("uri", ["", "nonsense", "http://localhost", "http://localhost:99999"])
def test_unusable_master_uri_is_refused(tmp_path: Path, uri: str) -> None:
    with Probe({**ros_environment(1, tmp_path), "ROS_MASTER_URI": uri}) as probe:
        assert probe.process.wait() == 2
        probe.wait_for(lambda: bool(probe.events), "the error")
        assert probe.events[0].startswith(f"! invalid ROS master URI '{uri}'")


def test_unusable_node_name_is_refused(tmp_path: Path) -> None:
    with Probe(ros_environment(free_port(), tmp_path), "__name:=a/b") as probe:
        assert probe.process.wait() == 2
        probe.wait_for(lambda: bool(probe.events), "the error")
        assert probe.events[0].startswith("! invalid name for the ROS node: ")
