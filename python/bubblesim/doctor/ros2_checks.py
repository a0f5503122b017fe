# SPDX-License-Identifier: BSD-3-Clause
"""Check what the ROS 2 side of the node depends on: the build, the environment, UDP on loopback."""

from __future__ import annotations

import os
import socket
from collections.abc import Iterator

from bubblesim.doctor.finding import Finding, ok, problem

_LAST_DOMAIN = 232
_RANGES = {
    "": "this machine",
    "LOCALHOST": "this machine",
    "SUBNET": "the local network",
    "SYSTEM_DEFAULT": "the local network",
    "OFF": "no other node",
}
_FIRST_PORT = 7400  # of RTPS
_TIMEOUT = 2.0  # s


def check_ros2() -> Iterator[Finding]:
    """Check the environment of ROS 2 if this build has its side."""
    try:
        from bubblesim import _core
    except ImportError:
        return  # the checks of the build say so
    if not _core.messages.message_names(_core.messages.RosVersion.ROS2):
        yield ok("the ROS 2 side is not built; scripts/setup --with ros2 adds it")
        return
    domain = _domain()
    if domain is None:
        yield problem(
            f"ROS_DOMAIN_ID={os.environ['ROS_DOMAIN_ID']} is not a domain, 0 to {_LAST_DOMAIN}",
            "export ROS_DOMAIN_ID=0",
        )
        return
    name = os.environ.get("ROS_AUTOMATIC_DISCOVERY_RANGE", "")
    if name not in _RANGES:
        yield problem(
            f"ROS_AUTOMATIC_DISCOVERY_RANGE={name} must be one of {', '.join(filter(None, _RANGES))}",
            "unset ROS_AUTOMATIC_DISCOVERY_RANGE",
        )
        return
    where = "this machine" if os.environ.get("ROS_LOCALHOST_ONLY") == "1" else _RANGES[name]
    peers = [peer for peer in os.environ.get("ROS_STATIC_PEERS", "").split(";") if peer]
    also = f" and {', '.join(peers)}" if peers and where != "no other node" else ""
    yield ok(f"nodes of ROS 2 are looked for in domain {domain} on {where}{also}")
    yield _check_loopback()


def _domain() -> int | None:
    text = os.environ.get("ROS_DOMAIN_ID", "") or "0"
    return int(text) if text.isascii() and text.isdigit() and int(text) <= _LAST_DOMAIN else None


def _check_loopback() -> Finding:
    """Send a packet to this process, as nodes of this machine do."""
    with (
        socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as receiver,
        socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as sender,
    ):
        receiver.bind(("0.0.0.0", 0))  # as Fast DDS does
        receiver.settimeout(_TIMEOUT)
        try:
            sender.sendto(b"bubblesim", ("127.0.0.1", receiver.getsockname()[1]))
            receiver.recv(16)
        except OSError as error:
            ports = f"UDP {_FIRST_PORT} to 65535"
            return problem(
                f"nodes of ROS 2 cannot talk on this machine: {error}", f"let the firewall pass {ports} on lo"
            )
    return ok("UDP packets arrive on this machine")
