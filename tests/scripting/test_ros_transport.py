# SPDX-License-Identifier: BSD-3-Clause
"""Transport hints in the forms used by scripts."""

from typing import Any

import pytest

from bubblesim.scripting.api.ros.transport import TransportHints, read_transport_hints


@pytest.mark.parametrize(
    ("given", "read"),
    [
        (None, TransportHints()),
        ({}, TransportHints()),
        ({"tcpNoDelay": False, "transports": ["reliable", "udp"]}, TransportHints(tcp_no_delay=False)),
        ({"tcpNoDelay": 1, "transports": ["unreliable"], "maxDatagramSize": 1000}, TransportHints(wants_udp=True)),
    ],
)
def test_hints_are_read(given: Any, read: TransportHints) -> None:
    assert read_transport_hints(given) == read


@pytest.mark.parametrize(
    ("given", "reported"),
    [
        ("tcp", "transport hints must be a dict, found str 'tcp'"),
        ({"tcpNodelay": True}, "have no 'tcpNodelay'; valid keys: transports, tcpNoDelay, maxDatagramSize"),
        ({"tcpNoDelay": "yes"}, "tcpNoDelay must be true or false, found str 'yes'"),
        ({"transports": 5}, "transports must be a list, found int 5"),
        (
            {"transports": ["carrier pigeon"]},
            "transports must hold 'reliable', 'tcp', 'unreliable', 'udp'; found str 'carr",
        ),
        ({"transports": [["tcp"]]}, "transports must hold "),
        ({"maxDatagramSize": 1.5}, "maxDatagramSize must be an integer, found float 1.5"),
        ({"maxDatagramSize": -1}, "maxDatagramSize must be 0 to 65507 bytes, found -1"),
        ({"maxDatagramSize": 10**30}, "maxDatagramSize must be 0 to 65507 bytes"),
    ],
)
def test_what_is_no_hint_is_reported_with_what_is(given: Any, reported: str) -> None:
    with pytest.raises((TypeError, ValueError)) as error:
        read_transport_hints(given)
    assert reported in str(error.value)
