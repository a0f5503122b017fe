# SPDX-License-Identifier: BSD-3-Clause
"""QoS arguments in the forms used by ROS 2 tutorials."""

from typing import Any

import pytest

from bubblesim.scripting.api.ros.qos import Qos, read_qos


@pytest.mark.parametrize(
    ("given", "read"),
    [
        (10, Qos(10, latch=False)),
        (3.0, Qos(3, latch=False)),
        ({}, Qos(1, latch=False)),
        ({"depth": 5, "history": "keep_last", "reliability": "best_effort"}, Qos(5, latch=False)),
        ({"durability": "TRANSIENT_LOCAL"}, Qos(1, latch=True)),
        ({"durability": "volatile", "history": "keep_all"}, Qos(0, latch=False)),
    ],
)
def test_depth_is_the_queue_and_transient_local_latches(given: Any, read: Qos) -> None:
    assert read_qos(given) == read


@pytest.mark.parametrize(
    ("given", "reported"),
    [
        ({"dept": 5}, "QoS has no 'dept'; valid keys: depth, "),
        ({"durability": "latched"}, "one of volatile, transient_local, "),
        (-1, "not be negative"),
        ("many", "an integer"),
    ],
)
def test_what_is_no_qos_is_reported_with_what_is(given: Any, reported: str) -> None:
    with pytest.raises((TypeError, ValueError), match=reported):
        read_qos(given)
