# SPDX-License-Identifier: BSD-3-Clause
"""QoS arguments in the forms used by ROS 2 tutorials."""

from typing import Any

import pytest
from bubblesim._core import Qos

from bubblesim.scripting.api.ros.qos import read_qos


@pytest.mark.parametrize("is_ros2", [False, True])
@pytest.mark.parametrize(
    ("given", "read"),
    [
        (10, Qos(10)),
        (3.0, Qos(3)),
        ({}, Qos(1)),
        ({"depth": 5, "history": "keep_last", "reliability": "best_effort"}, Qos(5, reliable=False)),
        ({"durability": "TRANSIENT_LOCAL"}, Qos(1, transient_local=True)),
        ({"durability": "volatile", "history": "keep_all"}, Qos(0)),
    ],
)
def test_depth_is_the_queue_and_words_are_policies(given: Any, read: Qos, is_ros2: bool) -> None:
    assert read_qos(given, is_ros2) == read


def test_times_are_seconds_or_those_of_messages_and_are_of_ros2_alone() -> None:
    given = {"deadline": {"sec": 1, "nanosec": 500_000_000}, "lifespan": 0.25}
    assert read_qos(given, is_ros2=True) == Qos(1, deadline=1.5, lifespan=0.25)
    assert read_qos(given, is_ros2=False) == Qos(1)
    assert read_qos({"deadline": 0, "lifespan": {"sec": 2**31 - 1, "nanosec": 0}}, is_ros2=True) == Qos(1)


@pytest.mark.parametrize(
    ("given", "reported"),
    [
        ({"dept": 5}, "QoS has no 'dept'; valid keys: depth, "),
        ({"durability": "latched"}, "one of volatile, transient_local, "),
        ({"lifespan": -1}, "lifespan must be seconds or {sec, nanosec}, found -1"),
        ({"liveliness": "manual_by_topic"}, "manual_by_topic is not supported"),
        ({"liveliness_lease_duration": 1.0}, "liveliness_lease_duration is not supported"),
        (-1, "not be negative"),
        ("many", "an integer"),
    ],
)
def test_what_is_no_qos_is_reported_with_what_is(given: Any, reported: str) -> None:
    with pytest.raises((TypeError, ValueError), match=reported):
        read_qos(given, is_ros2=True)
