# SPDX-License-Identifier: BSD-3-Clause
"""Client of the simulator's services over one connection, without rospy, which takes a second to load."""

from __future__ import annotations

import socket
import struct
from typing import Any

from bubblesim import _core

_LENGTH = struct.Struct("<I")


class ServiceClient:
    """A persistent client of one service (wiki.ros.org/ROS/TCPROS)."""

    def __init__(self, address: tuple[str, int], name: str, service_type: str) -> None:
        """Connect; raise OSError on failure."""
        self._request, self._response = _core.messages.service_halves(service_type)
        self._socket = socket.create_connection(address)
        self._socket.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)
        header = {
            "callerid": "/bubblesim_test",
            "service": name,
            "md5sum": _core.messages.service_type_hash(service_type),
            "persistent": "1",
        }
        fields = [f"{key}={value}".encode() for key, value in header.items()]
        self._send(b"".join(_LENGTH.pack(len(field)) + field for field in fields))
        self._receive()  # the server's header

    def call(self, **request: Any) -> dict[str, Any]:
        """Return the response. Raise ConnectionError if the server closes, RuntimeError if the call fails."""
        self._send(_core.messages.encode(self._request, request))
        succeeded = self._read(1) == b"\x01"
        data = self._receive()
        if not succeeded:
            raise RuntimeError(data.decode(errors="replace"))
        response: dict[str, Any] = _core.messages.decode(self._response, data, _core.messages.TimeForm.FLOAT)
        return response

    def close(self) -> None:
        """Close the connection."""
        self._socket.close()

    def _send(self, data: bytes) -> None:
        self._socket.sendall(_LENGTH.pack(len(data)) + data)

    def _receive(self) -> bytes:
        return self._read(_LENGTH.unpack(self._read(_LENGTH.size))[0])

    def _read(self, count: int) -> bytes:
        data = bytearray()
        while len(data) < count:
            part = self._socket.recv(count - len(data))
            if not part:
                raise ConnectionError("the simulator has closed the connection")
            data += part
        return bytes(data)
