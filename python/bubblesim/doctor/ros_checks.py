# SPDX-License-Identifier: BSD-3-Clause
"""Check the connections between this terminal, the ROS master and other nodes."""

from __future__ import annotations

import os
import socket
import urllib.parse
from collections.abc import Iterator
from typing import Any

from bubblesim.doctor.finding import Finding, ok, problem, warning
from bubblesim.program.addresses import master_uri
from bubblesim.program.ros_calls import RosCallError, call
from bubblesim.program.simulators import simulators

_CALLER = "/bubblesim_doctor"
_TIMEOUT = 5.0  # s, also on a busy machine
_MAX_NODES = 50


def check_names() -> Iterator[Finding]:
    """Check that the host name, which nodes send to each other, resolves."""
    variable = next((name for name in ("ROS_HOSTNAME", "ROS_IP") if os.environ.get(name)), None)
    name = os.environ[variable] if variable else socket.gethostname()
    whose = f"{variable}={name}" if variable else f"this machine's name, {name},"
    if _resolves(name):
        yield ok(f"other nodes reach this machine as {name}")
    else:
        yield problem(f"{whose} does not resolve, so nodes cannot connect", "export ROS_HOSTNAME=localhost")


def check_master() -> Iterator[Finding]:
    """Check the master at ROS_MASTER_URI, its clock and its nodes."""
    uri = master_uri()
    parts = urllib.parse.urlsplit(uri)
    try:
        host, port = parts.hostname, parts.port
    except ValueError:
        host = port = None
    if parts.scheme != "http" or not host or not port:
        yield problem(
            f"ROS_MASTER_URI={uri} must have the form http://HOST:PORT", "export ROS_MASTER_URI=http://localhost:11311"
        )
        return
    if not _resolves(host):
        yield problem(f"ROS_MASTER_URI={uri}: {host} does not resolve", "export ROS_MASTER_URI=http://localhost:11311")
        return
    try:
        socket.create_connection((host, port), _TIMEOUT).close()
    except OSError:
        yield warning(
            f"no ROS master answers at {uri}", "start roscore in another terminal, or use bubblesim run ... --roscore"
        )
        return
    try:
        _ask(uri, "getPid")
    except RosCallError:
        yield problem(
            f"the program that listens at {uri} is not a ROS master",
            f"ss -ltnp 'sport = :{port}' shows the program; end it, or use another port: "
            f"export ROS_MASTER_URI=http://{host}:{port + 1}",
        )
        return
    yield ok(f"a ROS master answers at {uri}")
    yield from _check_clock(uri)
    yield from _check_nodes(uri)


def _check_clock(master: str) -> Iterator[Finding]:
    state = _ask(master, "getSystemState")
    publishers = dict(state[0])
    running = [node for node in simulators(state) if _responds(master, node)]
    if len(running) > 1:
        yield problem(
            f"nodes receive the times of {len(running)} simulators on /clock: {', '.join(running)}",
            f"rosnode kill {running[-1]}, and run it with a master of its own: bubblesim run SCENE --isolated",
        )
    if not _ask(master, "hasParam", "/use_sim_time") or not _ask(master, "getParam", "/use_sim_time"):
        return
    if "/clock" in publishers:
        yield ok("nodes use the time from /clock")
    else:
        yield problem(
            "nodes wait forever for the time: /use_sim_time is set, but no node publishes /clock",
            "rosparam delete /use_sim_time, or start a simulator",
        )


def _check_nodes(master: str) -> Iterator[Finding]:
    state = _ask(master, "getSystemState")
    nodes = sorted({node for entries in state for _, names in entries for node in names})[:_MAX_NODES]
    missing = [node for node in nodes if not _responds(master, node)]
    if missing:
        yield warning(f"nodes registered at the master do not respond: {', '.join(missing)}", "rosnode cleanup")


def _responds(master: str, node: str) -> bool:
    try:
        _ask(_ask(master, "lookupNode", node), "getPid")
    except RosCallError:
        return False
    return True


def _ask(uri: str, function: str, *arguments: object) -> Any:
    return call(uri, _CALLER, function, *arguments)


def _resolves(name: str) -> bool:
    try:
        socket.getaddrinfo(name, None)
    except OSError:
        return False
    return True
