# SPDX-License-Identifier: BSD-3-Clause
"""The sockets of scripts: known, so that a stop ends what waits for them; and a start can bind the same ports again."""

from __future__ import annotations

import contextlib
import socket
import sys
import threading
import weakref

Sockets = weakref.WeakSet[socket.socket]

_local = threading.local()
_installed = False


def install() -> None:
    """From now on note the sockets that Python makes."""
    global _installed
    if not _installed:
        sys.addaudithook(_hear)  # cannot be taken back
    _installed = True


def note_in(sockets: Sockets | None) -> Sockets | None:
    """Note the sockets that this thread makes from now on, accepted ones included; returns where it did so before."""
    before: Sockets | None = getattr(_local, "sockets", None)
    _local.sockets = sockets
    return before


def shut_down(sockets: Sockets) -> None:
    """Let all that wait for one of them go on at once; accept and recv fail or find the end."""
    for each in list(sockets):
        with contextlib.suppress(OSError):  # not connected, or closed
            each.shutdown(socket.SHUT_RDWR)


def _hear(event: str, arguments: tuple[object, ...]) -> None:
    if event not in ("socket.__new__", "socket.bind"):
        return
    subject = arguments[0]
    sockets: Sockets | None = getattr(_local, "sockets", None)
    if sockets is None or not isinstance(subject, socket.socket):
        return
    if event == "socket.__new__":
        sockets.add(subject)
    elif subject.type == socket.SOCK_STREAM and subject.family in (socket.AF_INET, socket.AF_INET6):
        # Connections of before that the system has not forgotten yet shall not keep the port.
        subject.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
