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
            socket.create_server(("127.0.0.1", port)).close()
        except OSError as error:
            yield warning(
                f"cannot bind port {port}, which the scene {scene} needs: {error.strerror}",
                f"ss -ltnp 'sport = :{port}' shows the process that uses it; end that process",
            )
        else:
            yield ok(f"port {port} is free for the scene {scene}")
