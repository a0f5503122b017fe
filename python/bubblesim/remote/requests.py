# SPDX-License-Identifier: BSD-3-Clause
"""What a request of a remote client means: a call, the end of a callback, the end of the client, or its token."""

from __future__ import annotations

from functools import partial

from bubblesim.remote import protocol
from bubblesim.remote.calls import Calls
from bubblesim.remote.client_socket import ClientSocket
from bubblesim.remote.clients import Clients
from bubblesim.remote.function_calls import carry_out, info
from bubblesim.remote.remote_client import ClientConnection
from bubblesim.remote.token import is_same

_TOKEN = "bubblesim.token"
_NEEDS_TOKEN = (
    "this node wants a token (--remote-token=FILE), the text in FILE: client.call('bubblesim.token', [TOKEN]) first, "
    "or bubblesim.connect(token=FILE)"
)


class Requests:
    """Hands requests over to those who answer them."""

    def __init__(self, socket: ClientSocket, clients: Clients, calls: Calls, token: str) -> None:
        """Begin.

        :param token: which clients must send; empty: they need none.
        """
        self._socket = socket
        self._clients = clients
        self._calls = calls
        self._token = token
        self._info = protocol.Reply(protocol.encode({"ret": [info()]}))

    def handle(self, connection: ClientConnection, data: bytes, is_answered: bool) -> None:
        """Handle a request.

        :param is_answered: it was answered when it was received ahead.
        """
        try:
            request = protocol.decode(data)
            if is_answered:
                self._register(connection, request)
            else:
                self._handle(connection, request)
        except protocol.RequestError as error:
            self._socket.send(connection, protocol.error(str(error)))
        except Exception as error:
            connection.clear()
            self._socket.send(connection, protocol.error_of(error))
            raise

    def constant_reply(self, request: protocol.Request) -> bytes | None:
        """Return the reply that depends on nothing but the request; None for other requests."""
        if request.function == _TOKEN:
            return protocol.result(None)
        if request.arguments != ["sim"]:
            return None
        return {"zmqRemoteApi.require": protocol.result(None), "zmqRemoteApi.info": self._info}.get(request.function)

    def has_token(self, request: protocol.Request) -> bool:
        """Return whether a request has the token, or none is wanted."""
        if not self._token:
            return True
        sent = request.arguments[0] if request.function == _TOKEN and request.arguments else request.token
        return isinstance(sent, str) and is_same(sent, self._token)

    def _handle(self, connection: ClientConnection, request: protocol.Request) -> None:
        if not request.uuid:
            message = protocol.encode({"success": False, "error": "the request has no uuid"})
            self._socket.send(connection, message)
            return
        connection.has_token = connection.has_token or self.has_token(request)
        if not connection.has_token:
            self._socket.send(connection, protocol.error(_NEEDS_TOKEN))
            return
        if request.function == _TOKEN:
            self._socket.send(connection, protocol.result(None))
            return
        client = self._clients.client_of(connection, request.uuid, request.timeout)
        if request.function == protocol.EXECUTED:
            self._calls.returned(connection, request.arguments)
        elif request.function == protocol.END:
            self._clients.forget(client)
            self._socket.send(connection, protocol.encode({}))
        elif request.function == "zmqRemoteApi.info" and request.arguments == ["sim"]:
            self._calls.begin(connection, lambda: self._info)
        else:
            self._calls.begin(connection, partial(carry_out, request, self._clients.sim_of(request.uuid), client))

    def _register(self, connection: ClientConnection, request: protocol.Request) -> None:
        """Note which client has sent a request that is answered already."""
        connection.has_token = connection.has_token or self.has_token(request)
        if request.function != _TOKEN:
            self._clients.client_of(connection, request.uuid, request.timeout)
