# SPDX-License-Identifier: BSD-3-Clause
"""Check that the ports used by scenes are free."""

from __future__ import annotations

import socket
from collections.abc import Iterator

from bubblesim.doctor.finding import Finding, ok, warning

_SERVED = {5000: "tricycle_socket"}  # on 127.0.0.1, by scene


def check_ports() -> Iterator[Finding]:
    """Check each port of the scenes of bubblesim."""
    for port, scene in _SERVED.items():
        try:
            _bind(port)
        except OSError as error:
            yield warning(
                f"cannot bind port {port}, which the scene {scene} needs: {error.strerror}",
                f"ss -ltnp 'sport = :{port}' shows the process that uses it; end that process",
            )
        else:
            yield ok(f"port {port} is free for the scene {scene}")


def _bind(port: int) -> None:
    """Raise OSError if a program listens on the port. Does not listen itself: a scene may start at this moment."""
    with socket.socket() as probe:
        probe.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
        probe.bind(("127.0.0.1", port))
