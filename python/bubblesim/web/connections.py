# SPDX-License-Identifier: BSD-3-Clause
"""The connections to the server: how many there may be, and what one may take without the token.

aiohttp waits without end for a request, and accepts all connections. Here a connection without the token, which anyone
can open, ends soon, and there are few of them: the oldest makes room for the next, one without a request first. Pages
have places of their own.
"""

from __future__ import annotations

import asyncio
from typing import cast

MOST_WAITING = 64  # connections that are not accepted yet
ACCEPTED_AT_ONCE = 8  # so that requests which are there already are read before _MOST_OTHERS more are accepted
_MOST_PAGES = 40  # with the token; each has up to 17 descriptors
_MOST_OTHERS = 120  # and for a moment some more: those of a turn of the loop are accepted before one is closed
_MOST_BYTES = 64 * 1024  # from a connection without the token
_FIRST_REQUEST = 5.0  # s until the headers of a request are there
_LONGEST = 60.0  # s after that, for the files of the page and the token


class Connections:
    """All connections, and which of them have shown the token."""

    def __init__(self) -> None:
        """Begin without connections."""
        self._others: dict[asyncio.BaseTransport, Connection] = {}  # the oldest first
        self._pages: dict[asyncio.BaseTransport, Connection] = {}

    def add(self, connection: Connection) -> None:
        """Count a connection. If there are too many, close the oldest without a request, or else the oldest."""
        if len(self._others) >= _MOST_OTHERS:
            oldest = next(iter(self._others.values()))
            without_request = (other for other in self._others.values() if not other.has_request)
            self._others.pop(next(without_request, oldest).transport).transport.abort()
        self._others[connection.transport] = connection

    def remove(self, connection: Connection) -> None:
        """Forget a connection that is closed."""
        self._others.pop(connection.transport, None)
        self._pages.pop(connection.transport, None)

    def note_request(self, transport: asyncio.BaseTransport | None) -> None:
        """Give a connection time, because it has sent the headers of a request."""
        if transport in self._others:
            self._others[transport].note_request()

    def trust(self, transport: asyncio.BaseTransport | None) -> bool:
        """Lift the limits of a connection, because it has the token; return false if there are too many such."""
        if transport not in self._others or len(self._pages) >= _MOST_PAGES:
            return False
        self._pages[transport] = connection = self._others.pop(transport)
        connection.trust()
        return True


class Connection(asyncio.Protocol):
    """Passes on all that happens on a connection, within its limits."""

    transport: asyncio.Transport

    def __init__(self, connections: Connections, protocol: asyncio.Protocol) -> None:
        """Begin without the token.

        :param protocol: of aiohttp, which does the work.
        """
        self._connections = connections
        self._protocol = protocol
        self.has_request = False
        self._trusted = False
        self._bytes = 0
        self._end: asyncio.TimerHandle | None = None

    def connection_made(self, transport: asyncio.BaseTransport) -> None:
        """Begin to wait for a request."""
        self.transport = cast(asyncio.Transport, transport)
        self._connections.add(self)
        self._end_after(_FIRST_REQUEST)
        self._protocol.connection_made(transport)

    def note_request(self) -> None:
        """Wait for the token, but not for ever."""
        if not self.has_request:
            self.has_request = True
            self._end_after(_LONGEST)

    def trust(self) -> None:
        """Lift the limits."""
        self._trusted = True
        if self._end is not None:
            self._end.cancel()

    def _end_after(self, seconds: float) -> None:
        if self._end is not None:
            self._end.cancel()
        self._end = asyncio.get_running_loop().call_later(seconds, self.transport.abort)

    def data_received(self, data: bytes) -> None:
        """Pass on data, or close the connection if it has sent too much."""
        if not self._trusted:
            self._bytes += len(data)
            if self._bytes > _MOST_BYTES:
                self.transport.abort()
                return
        self._protocol.data_received(data)

    def eof_received(self) -> bool | None:
        """Pass on the end of the data."""
        return self._protocol.eof_received()

    def connection_lost(self, exc: Exception | None) -> None:
        """Forget the connection."""
        if self._end is not None:
            self._end.cancel()
        self._connections.remove(self)
        self._protocol.connection_lost(exc)

    def pause_writing(self) -> None:
        """Pass on that the peer does not read."""
        self._protocol.pause_writing()

    def resume_writing(self) -> None:
        """Pass on that the peer reads again."""
        self._protocol.resume_writing()
