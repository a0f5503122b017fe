# SPDX-License-Identifier: BSD-3-Clause
"""Finds a client's stop while a script that does not return keeps the thread that serves the clients.

The watchdog of the scripts calls it in its own thread. Messages are received ahead and handled later, in their order: a
stop only lets the watchdog interrupt the script. A client that connects now asks for the functions of `sim` before it
can send a stop; since the answer depends on nothing, it is sent at once.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping

from bubblesim.remote import protocol
from bubblesim.remote.remote_client import ClientConnection
from bubblesim.remote.router import NO_DESCRIPTOR, Received, Router

_STOPS = ("sim.stopSimulation", "sim.quitSimulator")
_MOST_BYTES = 4096  # of a message that is looked at


class WaitingStops:
    """Looks at what the clients have sent since the script is stuck."""

    def __init__(
        self,
        router: Router,
        connections: Mapping[bytes, ClientConnection],
        answer: Callable[[protocol.Request], bytes | None],
        knows_token: Callable[[protocol.Request], bool],
    ) -> None:
        """Begin without messages.

        :param answer: returns the reply to a request that depends on nothing, and None for others.
        :param knows_token: returns whether a request has the token that clients must know, if they must.
        """
        self._router = router
        self._connections = connections
        self._answer = answer
        self._knows_token = knows_token
        self._let_in: set[bytes] = set()  # identities of those that have sent the token meanwhile
        self._unanswered: set[bytes] = set()
        self._found = False

    def look(self) -> bool:
        """Receive ahead what waits; return whether there was anything."""
        return self._router.receive_ahead(self._connections, self._look_at)

    def found(self) -> bool:
        """Return whether a stop waits."""
        return self._found

    def forget(self) -> None:
        """Begin again: all that was received ahead is handled."""
        self._let_in.clear()
        self._unanswered.clear()
        self._found = False

    def _look_at(self, received: Received) -> bool:
        """Note a stop; return whether the message was answered."""
        identity, connection = received.identity, self._connections.get(received.identity)
        is_first = identity not in self._unanswered and (
            connection is None or not connection.is_open or connection.calls_back
        )
        request = _read(received) if is_first else None
        if request is not None and self._may_call(identity, connection, request):
            reply = None if connection is not None and connection.calls_back else self._answer(request)
            if reply is not None and self._router.send(identity, reply):
                return True
            self._found = self._found or request.function in _STOPS
        self._unanswered.add(identity)
        return False

    def _may_call(self, identity: bytes, connection: ClientConnection | None, request: protocol.Request) -> bool:
        if self._knows_token(request):
            self._let_in.add(identity)
        return identity in self._let_in or (connection is not None and connection.has_token)


def _read(received: Received) -> protocol.Request | None:
    """Return a short request that is well-formed; the others can wait for their errors."""
    if received.request is None or received.descriptor == NO_DESCRIPTOR or len(received.request) > _MOST_BYTES:
        return None
    try:
        request = protocol.decode(received.request)
    except protocol.RequestError:
        return None
    return request if request.uuid else None
