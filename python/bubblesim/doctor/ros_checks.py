# SPDX-License-Identifier: BSD-3-Clause
"""Whether this terminal can talk to a ROS master and be talked to."""

from __future__ import annotations

import http.client
import os
import socket
import urllib.parse
import xmlrpc.client
from collections.abc import Iterator
from typing import Any

from bubblesim.doctor.finding import Finding, ok, problem, warning

_CALLER = "/bubblesim_doctor"
_PATIENCE = 2.0  # s, for a master
_MOST_NODES = 50


def check_names() -> Iterator[Finding]:
    """Nodes tell each other the name of their machine."""
    variable = next((name for name in ("ROS_HOSTNAME", "ROS_IP") if os.environ.get(name)), None)
    name = os.environ[variable] if variable else socket.gethostname()
    whose = f"{variable}={name}" if variable else f"this machine's name, {name},"
    if _resolves(name):
        yield ok(f"other nodes reach this machine as {name}")
    else:
        yield problem(f"{whose} is no address, so that no node would reach another", "export ROS_HOSTNAME=localhost")


def check_master() -> Iterator[Finding]:
    """A master at ROS_MASTER_URI, and what it knows."""
    uri = os.environ.get("ROS_MASTER_URI", "")
    parts = urllib.parse.urlsplit(uri)
    try:
        host, port = parts.hostname, parts.port
    except ValueError:
        host = port = None
    if parts.scheme != "http" or not host or not port:
        yield problem(
            f"ROS_MASTER_URI={uri} is not like http://HOST:PORT", "export ROS_MASTER_URI=http://localhost:11311"
        )
        return
    if not _resolves(host):
        yield problem(f"ROS_MASTER_URI={uri}: {host} is no address", "export ROS_MASTER_URI=http://localhost:11311")
        return
    try:
        socket.create_connection((host, port), _PATIENCE).close()
    except OSError:
        yield warning(
            f"no ROS master answers at {uri}", "roscore, in a terminal of its own; or bubblesim run ... --roscore"
        )
        return
    master = _proxy(uri)
    try:
        _ask(master.getPid)
    except (OSError, xmlrpc.client.Error, http.client.HTTPException, ValueError):
        yield problem(
            f"what listens at {uri} does not answer as a ROS master does",
            f"ss -ltnp 'sport = :{port}' tells what it is: end it, or take another port: "
            f"export ROS_MASTER_URI=http://{host}:{port + 1}",
        )
        return
    yield ok(f"a ROS master answers at {uri}")
    yield from _check_clock(master)
    yield from _check_nodes(master)


def _check_clock(master: Any) -> Iterator[Finding]:
    publishers = dict(_ask(master.getSystemState)[0])
    if not _ask(master.hasParam, "/use_sim_time") or not _ask(master.getParam, "/use_sim_time"):
        return
    if "/clock" in publishers:
        yield ok("nodes take their time from /clock")
    else:
        yield problem(
            "nodes wait for ever for the time: /use_sim_time is set, and nobody publishes /clock",
            "rosparam delete /use_sim_time, or start a simulator",
        )


def _check_nodes(master: Any) -> Iterator[Finding]:
    books = _ask(master.getSystemState)
    nodes = sorted({node for book in books for _, names in book for node in names})[:_MOST_NODES]
    gone = [node for node in nodes if not _lives(master, node)]
    if gone:
        yield warning(f"the master knows nodes that do not answer: {', '.join(gone)}", "rosnode cleanup")


def _lives(master: Any, node: str) -> bool:
    try:
        _ask(_proxy(_ask(master.lookupNode, node)).getPid)
    except (OSError, xmlrpc.client.Error, http.client.HTTPException, ValueError):
        return False
    return True


def _ask(method: Any, *arguments: object) -> Any:
    code, message, value = method(_CALLER, *arguments)
    if code != 1:
        raise ValueError(message)
    return value


def _proxy(uri: str) -> Any:
    return xmlrpc.client.ServerProxy(uri, transport=_ImpatientTransport())


class _ImpatientTransport(xmlrpc.client.Transport):
    def make_connection(self, host: Any) -> http.client.HTTPConnection:
        connection = super().make_connection(host)
        connection.timeout = _PATIENCE
        return connection


def _resolves(name: str) -> bool:
    try:
        socket.getaddrinfo(name, None)
    except OSError:
        return False
    return True
