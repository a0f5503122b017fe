# SPDX-License-Identifier: BSD-3-Clause
"""The socket on which remote clients connect."""

from __future__ import annotations

import os
import sys

import zmq

from bubblesim.program.addresses import is_loopback, user_of_port
from bubblesim.program.output import write_line
from bubblesim.remote import protocol


def listen(
    context: zmq.Context[zmq.Socket[bytes]], address: str, port: int | None, path: str, *, wants_token: bool
) -> zmq.Socket[bytes]:
    """Return a socket that is bound to address:port and to a Unix domain socket, and log where.

    :param port: 0 takes a free one, None listens on no port.
    :param path: of the Unix domain socket, in a folder that only this user may enter; empty: none.
    :param wants_token: clients must know a token.
    :raises RuntimeError: if the address or the path cannot be used. After an error the context is terminated.
    """
    socket = context.socket(zmq.ROUTER)
    try:
        _bind(socket, address, port, path)
        if port is not None:
            _log_who_can_connect(socket.getsockopt_string(zmq.LAST_ENDPOINT).rstrip("\0"), address, wants_token)
    except BaseException:
        socket.close(0)
        context.term()
        raise
    return socket


def _bind(socket: zmq.Socket[bytes], address: str, port: int | None, path: str) -> None:
    socket.setsockopt(zmq.LINGER, 1000)  # ms for the last replies
    socket.setsockopt(zmq.MAXMSGSIZE, protocol.MOST_BYTES + 1024)
    socket.setsockopt(zmq.RCVHWM, 2)  # a client has one request at a time; more wait in its own memory
    socket.setsockopt(zmq.SNDHWM, 2)  # replies that are not read
    socket.setsockopt(zmq.ROUTER_MANDATORY, 1)  # sending to a client that is gone is an error
    socket.setsockopt(zmq.HEARTBEAT_IVL, 10_000)  # ms; finds machines that are gone
    socket.setsockopt(zmq.HEARTBEAT_TIMEOUT, 30_000)
    try:
        where = path
        if path:
            socket.bind(f"ipc://{path}")
        if port is not None:
            where = f"{address}:{port}"
            socket.bind(f"tcp://{address}:{port or '*'}")
    except zmq.ZMQError as error:
        reason = os.strerror(error.errno or 0)  # error.strerror also has the address in pyzmq 26
        if error.errno == zmq.EADDRINUSE and port:
            reason += user_of_port(port)
        raise RuntimeError(f"cannot listen on {where}: {reason}; another port: --remote=PORT") from None


def _log_who_can_connect(where: str, address: str, wants_token: bool) -> None:
    write_line(sys.stderr, f"info: remote clients can connect to {where}")
    if is_loopback(address):
        if not wants_token:
            write_line(sys.stderr, "info: so can all users of this machine; --remote-token=FILE refuses them")
    elif wants_token:
        write_line(sys.stderr, f"warning: the connections to {address} are not encrypted")
    else:
        write_line(sys.stderr, f"warning: all who reach {address} can control the simulation: there is no token")
