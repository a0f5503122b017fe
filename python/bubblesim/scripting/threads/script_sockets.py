# SPDX-License-Identifier: BSD-3-Clause
"""The sockets of scripts: shut down on a stop, and bound with SO_REUSEADDR so that a restart can use the same ports."""

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
    """Record the sockets created in Python from now on."""
    global _installed
    if not _installed:
        sys.addaudithook(_on_audit_event)  # audit hooks cannot be removed
    _installed = True


def record_in(sockets: Sockets | None) -> Sockets | None:
    """Record this thread's new sockets, including accepted ones, in a set from now on; return the previous set."""
    before: Sockets | None = getattr(_local, "sockets", None)
    _local.sockets = sockets
    return before


def shut_down(sockets: Sockets) -> None:
    """Wake all threads that wait for these sockets; accept and recv fail or return the end of the stream."""
    for each in list(sockets):
        with contextlib.suppress(OSError):  # not connected, or closed
            each.shutdown(socket.SHUT_RDWR)


def _on_audit_event(event: str, arguments: tuple[object, ...]) -> None:
    if event not in ("socket.__new__", "socket.bind"):
        return
    subject = arguments[0]
    sockets: Sockets | None = getattr(_local, "sockets", None)
    if sockets is None or not isinstance(subject, socket.socket):
        return
    if event == "socket.__new__":
        sockets.add(subject)
    elif subject.type == socket.SOCK_STREAM and subject.family in (socket.AF_INET, socket.AF_INET6):
        # Old connections in the state TIME_WAIT must not block the port.
        subject.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
