# SPDX-License-Identifier: BSD-3-Clause
"""Sends junk to a TCP port until it is ended: python rude_client.py PORT. It prints a line when it has begun."""

import os
import socket
import struct
import sys
from collections.abc import Iterator
from contextlib import contextmanager, suppress

from ros_support import start, stop

_MEGABYTE = 1_000_000
_DEEP = 100_000
_ZMTP_GREETING = b"\xff" + bytes(8) + b"\x7f\x03\x00NULL" + bytes(16) + bytes(32)
_ZMTP_READY = b"\x04\x1a\x05READY\x0bSocket-Type\x00\x00\x00\x03REQ"


def _http(body: bytes) -> bytes:
    return b"POST / HTTP/1.1\r\nHost: x\r\nContent-Length: %d\r\n\r\n" % len(body) + body


def _zmtp(body: bytes) -> bytes:
    """Return a connection of a REQ socket that sends one request."""
    return _ZMTP_GREETING + _ZMTP_READY + b"\x01\x00\x02" + struct.pack(">Q", len(body)) + body


@contextmanager
def junk_sent_to(port: int) -> Iterator[None]:
    """Let a program send junk to a port while the block runs."""
    with (process := start([sys.executable, __file__, str(port)], dict(os.environ), stdout=-1)):
        try:
            assert process.stdout
            assert process.stdout.readline() == "begun\n"
            yield
        finally:
            stop(process)


def junk() -> list[bytes]:
    """Return what is sent in turn: a megabyte without a newline, of random bytes, and values nested very deep."""
    nested_xml = b"<value><array><data>" * _DEEP
    nested_cbor = b"\xa3\x64func\x67sim.any\x64uuid\x61u\x64args" + b"\x81" * _DEEP
    return [
        b"1" * _MEGABYTE,
        os.urandom(_MEGABYTE),
        b"[" * _DEEP + b"\n",
        struct.pack("<I", _MEGABYTE) + os.urandom(_MEGABYTE),  # a TCPROS header
        _http(b"<methodCall><methodName>getPid</methodName><params><param>" + nested_xml),
        _http(b"[" * _DEEP),
        _zmtp(nested_cbor),
        _zmtp(os.urandom(_MEGABYTE)),
    ]


def main() -> None:
    """Send to the port of the command line."""
    port = int(sys.argv[1])
    kinds = junk()
    print("begun", flush=True)
    while True:
        for data in kinds:
            with suppress(OSError), socket.create_connection(("127.0.0.1", port), timeout=1.0) as connection:
                connection.sendall(data)


if __name__ == "__main__":
    with suppress(KeyboardInterrupt):
        main()
