# SPDX-License-Identifier: BSD-3-Clause
"""The messages of the server's ROUTER socket: one request or reply at a time, part by part.

Functions of pyzmq for messages of several parts take longer than all others together.
"""

from __future__ import annotations

import threading
from collections import deque
from collections.abc import Callable, Container
from typing import NamedTuple

import zmq

# As plain numbers: those of pyzmq are enumerations, whose operators take longer than sending.
_NOW = int(zmq.NOBLOCK)
_MORE_NOW = int(zmq.NOBLOCK | zmq.SNDMORE)
_HAS_MORE = int(zmq.RCVMORE)
_EVENTS = int(zmq.EVENTS)
_INPUT = int(zmq.POLLIN)

_MOST_AHEAD = 1000  # messages that are received ahead
_MOST_BYTES_AHEAD = 64 * 1024 * 1024

NO_DESCRIPTOR = -1
"""Instead of a descriptor: the peer uses a ZMTP before 3.0, for which libzmq has no descriptor of the connection."""


class Received(NamedTuple):
    """A message of a peer."""

    identity: bytes
    request: bytes | None
    """None if the message is not an empty part and one other, as a REQ socket sends it."""
    descriptor: int | None
    """Of the connection, or NO_DESCRIPTOR; None for a known peer."""
    is_answered: bool = False
    """It was answered when it was received ahead."""


class Router:
    """Receives and sends without waiting.

    The methods are for the thread that owns the socket, except ``receive_ahead``.
    """

    def __init__(self, socket: zmq.Socket[bytes]) -> None:
        """Use a ROUTER socket with ROUTER_MANDATORY."""
        self._socket = socket
        self._discards = False
        self._guard = threading.RLock()  # of the socket and of what was received ahead
        self._ahead: deque[Received] = deque()
        self._bytes_ahead = 0
        self._is_closed = False

    def has_input(self) -> bool:
        """Return whether there is something to receive; cheaper than an exception of ``receive``."""
        with self._guard:
            return bool(self._ahead) or self._is_readable()

    def _is_readable(self) -> bool:
        return bool(int(self._socket.getsockopt(_EVENTS)) & _INPUT)

    def receive(self, known: Container[bytes]) -> Received | None:
        """Return the next message; None after one more part of a message that has too many.

        :param known: identities of the peers whose descriptors are known.
        :raises zmq.ZMQError: if there is none.
        """
        with self._guard:
            if not self._ahead:
                return self._receive(known)
            received = self._ahead.popleft()
            self._bytes_ahead -= len(received.request or b"")
        if received.identity in known:
            return received._replace(descriptor=None)
        return received

    def receive_ahead(self, known: Container[bytes], look: Callable[[Received], bool]) -> bool:
        """Receive what waits and keep it for ``receive``, in its order; for any thread. Return whether there was any.

        :param look: called with each message; returns whether it has answered it.
        """
        found = False
        while len(self._ahead) < _MOST_AHEAD and self._bytes_ahead < _MOST_BYTES_AHEAD:
            with self._guard:
                if self._is_closed or not self._is_readable():
                    break
                received = self._receive(known)
                if received is not None:
                    self._ahead.append(received._replace(is_answered=look(received)))
                    self._bytes_ahead += len(received.request or b"")
            found = True
        return found

    def close(self) -> None:
        """Close the socket."""
        with self._guard:
            self._is_closed = True
            self._socket.disable_monitor()
            self._socket.close()

    def _receive(self, known: Container[bytes]) -> Received | None:
        receive, option = self._socket.recv, self._socket.getsockopt
        if self._discards:
            receive(_NOW)
            self._discards = bool(option(_HAS_MORE))
            return None
        identity = receive(_NOW)
        descriptor = None
        if identity in known:
            first = receive(_NOW)
        else:
            frame = self._socket.recv(_NOW, copy=False)
            first, descriptor = frame.bytes, _descriptor(frame)
        request = receive(_NOW) if option(_HAS_MORE) and not first else None
        self._discards = bool(option(_HAS_MORE))
        return Received(identity, None if self._discards else request, descriptor)

    def send(self, identity: bytes, message: bytes) -> bool:
        """Send a reply; return whether the peer is there and reads."""
        send = self._socket.send
        with self._guard:
            try:
                try:
                    send(identity, _MORE_NOW)
                except zmq.Again:
                    self._socket.getsockopt(_EVENTS)  # learns here how much the peer has read
                    send(identity, _MORE_NOW)
            except zmq.ZMQError:
                return False
            send(b"", _MORE_NOW)  # only the first part can fail
            send(message, _NOW)
        return True


def _descriptor(frame: zmq.Frame) -> int:
    try:
        return int(frame.get(zmq.SRCFD))
    except zmq.ZMQError:
        return NO_DESCRIPTOR
