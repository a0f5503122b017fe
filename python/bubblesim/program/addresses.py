# SPDX-License-Identifier: BSD-3-Clause
"""Addresses on which servers listen."""

from __future__ import annotations

import ipaddress
import os
from collections.abc import Sequence
from urllib.parse import urlsplit


def is_loopback(address: str) -> bool:
    """Return whether an address can be reached from this machine only."""
    try:
        return address == "localhost" or ipaddress.ip_address(address).is_loopback
    except ValueError:
        return False


def stay_on_this_machine(arguments: Sequence[str]) -> None:
    """Let a ROS node of this process listen on loopback only, if its master does and no address was chosen.

    :param arguments: of the command line, which may choose one (``__hostname:=``, ``__ip:=``) and the master.
    """
    master = os.environ.get("ROS_MASTER_URI", "http://localhost:11311")
    for argument in arguments:
        master = argument.removeprefix("__master:=") if argument.startswith("__master:=") else master
    chosen = any(os.environ.get(name) for name in ("ROS_HOSTNAME", "ROS_IP")) or any(
        argument.startswith(("__hostname:=", "__ip:=")) for argument in arguments
    )
    if not chosen and is_loopback(urlsplit(master).hostname or ""):
        os.environ["ROS_HOSTNAME"] = "localhost"
