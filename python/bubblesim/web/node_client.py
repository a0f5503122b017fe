# SPDX-License-Identifier: BSD-3-Clause
"""Calls of functions of the node, through its remote API server, without blocking this server."""

from __future__ import annotations

import asyncio
import uuid
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import cbor2
import zmq
import zmq.asyncio

_TIMEOUT = 660.0  # s; the longest wait in the node is shorter
_MOST_CONNECTIONS = 8  # of one client; each takes two descriptors


class NodeError(RuntimeError):
    """The simulator has answered with an error, or not at all."""


class NoAnswerError(NodeError):
    """There is no simulator, or it is busy."""


@dataclass
class _Connection:
    lock: asyncio.Lock
    socket: zmq.asyncio.Socket | None = None


class NodeClient:
    """A client of the node, such as a page. Calls on one of its connections wait for each other."""

    def __init__(self, context: zmq.asyncio.Context, address: str, token: Callable[[], str] = str) -> None:
        """Connect; this does not wait.

        :param address: of the remote API server, such as tcp://127.0.0.1:23000.
        :param token: returns the one that the node wants; empty: none.
        """
        self._token = token
        self._context = context
        self._address = address
        self._uuid = str(uuid.uuid4())
        self._connections: dict[str, _Connection] = {}

    async def call(self, function: str, *arguments: Any, timeout: float = _TIMEOUT) -> Any:
        """Call a function by its full name, and return its result.

        :raises NodeError: with the error of the function.
        """
        reply = cbor2.loads(await self.forward(function, list(arguments), timeout=timeout))
        if "err" in reply:
            raise NodeError(reply["err"])
        results = reply.get("ret", [])
        return results[0] if len(results) == 1 else results or None

    async def forward(
        self, function: str, arguments: list[Any], connection: str = "", timeout: float = _TIMEOUT
    ) -> bytes:
        """Call a function, and return the reply as the node sends it: a CBOR map with ``ret`` or ``err``.

        :param connection: by name; calls on different ones do not wait for each other.
        :raises NodeError: if there are too many connections, or no answer in ``timeout`` s.
        """
        if connection not in self._connections:
            if len(self._connections) >= _MOST_CONNECTIONS:
                known = list(self._connections)
                raise NodeError(f"{function}: no connection '{connection}': there are {len(known)} already: {known}")
            self._connections[connection] = _Connection(asyncio.Lock())
        used = self._connections[connection]
        message = {"func": function, "args": arguments, "uuid": self._uuid, "timeout": 86400, "token": self._token()}
        async with used.lock:
            socket = used.socket = used.socket or self._connect()
            try:
                await socket.send_multipart([b"", cbor2.dumps(message)])
                reply: list[bytes] = await asyncio.wait_for(socket.recv_multipart(), timeout)
            except BaseException as error:
                socket.close(0)  # a late answer would be taken for that of the next call
                used.socket = None
                if isinstance(error, TimeoutError):
                    raise NoAnswerError(f"{function}: no answer from the simulator in {timeout:g} s") from None
                raise
        return reply[-1]

    def close(self) -> None:
        """Disconnect."""
        for connection in self._connections.values():
            if connection.socket is not None:
                connection.socket.close(0)
        self._connections.clear()

    def _connect(self) -> zmq.asyncio.Socket:
        socket = self._context.socket(zmq.DEALER)
        socket.setsockopt(zmq.LINGER, 0)
        socket.setsockopt(zmq.HEARTBEAT_IVL, 5000)
        socket.setsockopt(zmq.HEARTBEAT_TIMEOUT, 15000)
        socket.connect(self._address)
        return socket
