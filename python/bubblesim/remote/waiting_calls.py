# SPDX-License-Identifier: BSD-3-Clause
"""The calls of remote clients that are answered later: after a step, a command, or a time."""

from __future__ import annotations

from collections.abc import Callable

from bubblesim.remote import protocol
from bubblesim.remote.alarm import Alarm
from bubblesim.remote.later_replies import Pending
from bubblesim.remote.remote_client import ClientConnection


class WaitingCalls:
    """By the identity of their connection. All methods are for the simulating thread."""

    def __init__(self, answer: Callable[[ClientConnection], None], wake: Callable[[], None]) -> None:
        """Begin without calls.

        :param answer: sends the reply of a connection.
        :param wake: called in another thread when a time has passed; ``answer_due`` must follow.
        """
        self._answer = answer
        self._connections: dict[bytes, ClientConnection] = {}  # those with a pending call; perhaps some others
        self._alarm = Alarm(wake)

    def add(self, connection: ClientConnection, pending: Pending) -> None:
        """Let the call of a connection wait."""
        connection.pending = pending
        self._connections[connection.identity] = connection
        if pending.due is not None:
            self._alarm.set(pending.due)

    def discard(self, connection: ClientConnection) -> None:
        """Forget the call of a connection that is gone."""
        self._connections.pop(connection.identity, None)

    def answer_done(self) -> None:
        """Answer the calls that need not wait any more."""
        for connection in list(self._connections.values()):
            if self.settle(connection):
                self._answer(connection)

    def answer_due(self) -> None:
        """Answer likewise, and wait for the next time."""
        self.answer_done()
        for connection in self._connections.values():
            if connection.pending is not None and connection.pending.due is not None:
                self._alarm.set(connection.pending.due)

    def settle(self, connection: ClientConnection) -> bool:
        """Turn a pending call into its reply if it is done."""
        pending = connection.pending
        try:
            if pending is not None and not pending.is_done():
                return False
            self._connections.pop(connection.identity, None)
            if pending is None:
                return False
            connection.reply = protocol.result(pending.result())
        except Exception as error:
            self._connections.pop(connection.identity, None)
            connection.reply = protocol.error_of(error)
        connection.pending = None
        return True

    def close(self) -> None:
        """Stop waiting for times."""
        self._alarm.close()
