# SPDX-License-Identifier: BSD-3-Clause
"""The socket of the remote clients and its connections, for the simulating thread.

The runner watches the descriptors of the socket and calls ``serve`` between steps, so a call finds the simulation at
rest. ZeroMQ's descriptors are edge-triggered: after each use of the socket outside of ``serve``, call ``serve_again``.
"""

from __future__ import annotations

import sys
import time
from collections.abc import Callable
from typing import Any

import zmq
from zmq.utils.monitor import recv_monitor_message

from bubblesim.program.output import write_line
from bubblesim.remote import protocol
from bubblesim.remote.remote_client import ClientConnection
from bubblesim.remote.router import NO_DESCRIPTOR, Received, Router

_SLICE = 0.005  # s of requests between two polls of other commands
_TOO_OLD = "the client uses a version of ZeroMQ's protocol before 3.0: use libzmq 4, JeroMQ 0.4 or a later one"
_MOST_REPORTED = 20  # errors of messages; a client could fill the disk


class ClientSocket:
    """Receives requests, sends replies, and notices connections that break."""

    def __init__(
        self,
        socket: zmq.Socket[bytes],
        handle: Callable[[ClientConnection, bytes, bool], None],
        note_lost: Callable[[ClientConnection], None],
    ) -> None:
        """Use a socket of ``listen``.

        :param handle: called with a connection, its request, and whether that was answered when it was received ahead.
        :param note_lost: called with a connection that is broken.
        """
        self._socket = socket
        self._handle = handle
        self._note_lost = note_lost
        self.router = Router(socket)
        self.connections: dict[bytes, ClientConnection] = {}
        """By identity."""
        self._monitor = socket.get_monitor_socket(zmq.EVENT_DISCONNECTED)
        self._watch: Any = None
        self._watch_of_monitor: Any = None
        self._reported = 0

    def watch(self, runner: Any) -> None:
        """Let a runner serve the socket."""
        self._watch = runner.watch(self._socket.getsockopt(zmq.FD), self.serve)
        self._watch_of_monitor = runner.watch(self._monitor.getsockopt(zmq.FD), self._serve_monitor)

    def end_watch(self) -> None:
        """Leave the runner; requests wait."""
        for watch in (self._watch, self._watch_of_monitor):
            if watch is not None:
                watch.close()
        self._watch = self._watch_of_monitor = None

    def serve_again(self) -> None:
        """Have ``serve`` called, whether the descriptor is ready or not."""
        if self._watch is not None:
            self._watch.serve_again()

    def serve(self) -> bool:
        """Handle requests for a while; return whether there are more."""
        end = time.perf_counter() + _SLICE
        while self.router.has_input():
            if time.perf_counter() > end:
                return True
            try:
                received = self.router.receive(self.connections)
                if received is not None:
                    self._receive(received)
            except Exception as error:  # one that leaves would end the watch for all clients
                self.report("a message of a remote client", error)
        return False

    def send(self, connection: ClientConnection, message: bytes) -> None:
        """Send a reply, or the call of a callback; a connection that takes none is dropped."""
        if not self.router.send(connection.identity, message):
            self._drop(connection)

    def report(self, what: str, error: Exception) -> None:
        """Log an error, unless there were too many."""
        self._reported += 1
        if self._reported <= _MOST_REPORTED:
            last = "; further ones are not reported" if self._reported == _MOST_REPORTED else ""
            write_line(sys.stderr, f"error: {what}: {type(error).__name__}: {error}{last}")

    @property
    def is_closed(self) -> bool:
        """Whether ``close`` was called."""
        return bool(self._socket.closed)

    def close(self) -> None:
        """Stop listening."""
        self.router.close()
        self._monitor.close(0)

    def _receive(self, received: Received) -> None:
        identity, data, descriptor, is_answered = received
        if descriptor == NO_DESCRIPTOR:
            self.router.send(identity, protocol.error(_TOO_OLD))
            return
        if descriptor is not None:
            self._serve_monitor()  # before a descriptor is known under its new owner
            self.connections[identity] = ClientConnection(identity, None, descriptor)
        connection = self.connections[identity]
        if data is None:
            self.send(connection, protocol.error("expected a request of one part: use a REQ socket"))
            return
        self._handle(connection, data, is_answered)

    def _serve_monitor(self) -> bool:
        """Drop the connections that broke."""
        try:
            while True:
                descriptor = int(recv_monitor_message(self._monitor, zmq.NOBLOCK)["value"])
                for connection in [each for each in self.connections.values() if each.descriptor == descriptor]:
                    self._drop(connection)
        except zmq.Again:
            return False
        except Exception as error:  # see serve
            self.report("the end of a connection of a remote client", error)
            return True

    def _drop(self, connection: ClientConnection) -> None:
        self.connections.pop(connection.identity, None)
        self._note_lost(connection)
