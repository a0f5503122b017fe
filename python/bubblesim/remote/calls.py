# SPDX-License-Identifier: BSD-3-Clause
"""The calls of remote clients, each from its beginning to its reply.

The reply comes at once, or after a step, a command or a time (Pending), or after functions of the client were called
(Conversation). Before a reply, a connection is sent the callbacks that wait for its client, one at a time. A callback
may make calls itself; then the call around it waits.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from bubblesim.remote import protocol
from bubblesim.remote.client_socket import ClientSocket
from bubblesim.remote.later_replies import Pending
from bubblesim.remote.remote_client import ClientConnection, RemoteClient
from bubblesim.remote.waiting_calls import WaitingCalls

_MOST_NESTED = 50  # calls in callbacks in calls
_ENDED = "the simulator has ended"


class Calls:
    """Carries out calls and sends their replies."""

    def __init__(self, socket: ClientSocket, wake: Callable[[], None]) -> None:
        """Begin without calls.

        :param wake: called in another thread when a time has passed; ``answer_due`` must follow.
        """
        self._socket = socket
        self._waiting = WaitingCalls(self._answer, wake)
        self._is_ending = False

    def begin(self, connection: ClientConnection, function: Callable[[], Any]) -> None:
        """Begin a call: of a connection without one, or in a callback.

        :param function: returns the result, which may be a Pending or a Conversation; its exception is the reply.
        """
        if (connection.is_open and not connection.calls_back) or len(connection.outer) >= _MOST_NESTED:
            self._socket.send(connection, protocol.error("the previous call on this socket is not answered yet"))
            return
        if connection.calls_back:  # a call in a callback
            connection.begin_inner()
        if self._is_ending:
            self._socket.send(connection, protocol.error(_ENDED))
            return
        try:
            value = function()
            if isinstance(value, Pending):
                self._waiting.add(connection, value)
                self._waiting.settle(connection)
            elif hasattr(value, "send"):
                connection.conversation = value
                self._go_on(connection, None)
            else:
                connection.reply = value if isinstance(value, protocol.Reply) else protocol.result(value)
        except Exception as error:
            connection.reply = protocol.error_of(error)
        self._send_next(connection)

    def returned(self, connection: ClientConnection, values: list[Any]) -> None:
        """Go on after a callback, from which the client has returned these values."""
        if not connection.calls_back:
            self._socket.send(connection, protocol.error("no callback was sent"))
            return
        connection.calls_back = False
        if connection.conversation is not None:
            self._go_on(connection, values[0] if len(values) == 1 else tuple(values) or None)
        else:
            self._waiting.settle(connection)
        self._send_next(connection)

    def deliver(self, client: RemoteClient) -> None:
        """Send the callbacks of a client if it waits for a reply."""
        for connection in list(client.connections.values()):  # one that cannot be sent to is dropped
            if client.callbacks and connection.is_open and not connection.calls_back:
                self._send_next(connection)
        self._socket.serve_again()

    def answer_done(self) -> None:
        """Reply to the calls that need not wait any more."""
        self._waiting.answer_done()

    def answer_due(self) -> None:
        """Reply likewise, and wait for the next time."""
        self._waiting.answer_due()

    def drop(self, connection: ClientConnection) -> None:
        """Forget the calls of a connection that is lost."""
        self._waiting.discard(connection)
        connection.clear()

    def refuse(self) -> None:
        """Refuse calls from now on, because the simulator ends."""
        self._is_ending = True

    def end(self) -> None:
        """Reply to all that wait that the simulator has ended."""
        for connection in list(self._socket.connections.values()):
            if connection.is_open:
                fits = connection.pending is not None and connection.pending.accepts_the_end
                self._socket.send(connection, protocol.result(None) if fits else protocol.error(_ENDED))
        self._waiting.close()

    def _go_on(self, connection: ClientConnection, value: Any) -> None:
        """Send the next callback of a conversation, or note its result as the reply."""
        assert connection.conversation is not None
        try:
            name, arguments = connection.conversation.send(value)
            message = protocol.call(name, arguments)
            connection.calls_back = True
            self._socket.send(connection, message)
            return
        except StopIteration as end:
            connection.reply = protocol.result(end.value)
        except Exception as error:
            connection.reply = protocol.error_of(error)
        connection.conversation = None

    def _send_next(self, connection: ClientConnection) -> None:
        """Send the next callback that waits for the client, or the reply if there is one."""
        if connection.calls_back or connection.conversation is not None:
            return
        if connection.client is not None and connection.client.callbacks:
            connection.calls_back = True
            self._socket.send(connection, connection.client.callbacks.take())
        elif connection.reply is not None:
            reply, connection.reply = connection.reply, None
            if connection.outer:
                connection.end_inner()
                if connection.pending is not None:
                    self._waiting.add(connection, connection.pending)
            self._socket.send(connection, reply)

    def _answer(self, connection: ClientConnection) -> None:
        """Send the reply of a call that has waited."""
        self._send_next(connection)
        self._socket.serve_again()
