# SPDX-License-Identifier: BSD-3-Clause
"""Addresses on which servers listen."""

from __future__ import annotations

import ipaddress
import os
from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path
from urllib.parse import urlsplit


def is_loopback(address: str) -> bool:
    """Return whether an address can be reached from this machine only."""
    try:
        return address == "localhost" or ipaddress.ip_address(address).is_loopback
    except ValueError:
        return False


def master_uri(environment: Mapping[str, str] = os.environ) -> str:
    """Return the address of the ROS master of an environment: the usual one if ROS_MASTER_URI is not set, as in ROS."""
    return environment.get("ROS_MASTER_URI", "http://localhost:11311")


def stay_on_this_machine(arguments: Sequence[str]) -> None:
    """Let a ROS node of this process listen on loopback only, if its master does and no address was chosen.

    :param arguments: of the command line, which may choose one (``__hostname:=``, ``__ip:=``) and the master.
    """
    master = master_uri()
    for argument in arguments:
        master = argument.removeprefix("__master:=") if argument.startswith("__master:=") else master
    chosen = any(os.environ.get(name) for name in ("ROS_HOSTNAME", "ROS_IP")) or any(
        argument.startswith(("__hostname:=", "__ip:=")) for argument in arguments
    )
    if not chosen and is_loopback(urlsplit(master).hostname or ""):
        os.environ["ROS_HOSTNAME"] = "localhost"


def user_of_port(port: int) -> str:
    """Return " (PROGRAM, process PID)" of who listens on a TCP port; empty if it is not a process of this user."""
    sockets = set(_sockets_on(port))
    for descriptor in Path("/proc").glob("[0-9]*/fd/*") if sockets else ():
        try:
            if str(descriptor.readlink()) in sockets:
                process = descriptor.parents[1]
                return f" ({(process / 'comm').read_text().strip()}, process {process.name})"
        except OSError:
            continue  # it has ended, or belongs to another user
    return ""


def ports_of(process: int) -> list[int]:
    """Return the TCP ports that a process of this user listens on."""
    links = set()
    for descriptor in Path(f"/proc/{process}/fd").glob("*"):
        try:
            links.add(str(descriptor.readlink()))
        except OSError:
            continue  # it was closed
    return sorted({port for port, link in _listening() if link in links})


def _sockets_on(port: int) -> Iterator[str]:
    """Yield what the descriptors of the sockets that listen on a port link to."""
    return (link for listening, link in _listening() if listening == port)


def _listening() -> Iterator[tuple[int, str]]:
    """Yield port and link of all sockets of this machine that listen."""
    listening = "0A"  # state in proc(5), /proc/net/tcp
    for table in ("/proc/net/tcp", "/proc/net/tcp6"):
        try:
            lines = Path(table).read_text().splitlines()[1:]
        except OSError:
            continue
        for line in lines:
            columns = line.split()
            if columns[3] == listening:
                yield int(columns[1].rpartition(":")[2], 16), f"socket:[{columns[9]}]"
