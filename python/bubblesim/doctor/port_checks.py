# SPDX-License-Identifier: BSD-3-Clause
"""Whether the ports that scenes serve are free."""

from __future__ import annotations

import socket
from collections.abc import Iterator

from bubblesim.doctor.finding import Finding, ok, warning

_SERVED = {5000: "tricycle_socket"}  # on 127.0.0.1, by scene


def check_ports() -> Iterator[Finding]:
    """Each port of a scene that comes with bubblesim."""
    for port, scene in _SERVED.items():
        try:
            socket.create_server(("127.0.0.1", port)).close()
        except OSError as error:
            yield warning(
                f"port {port}, which the scene {scene} serves, cannot be had: {error.strerror}",
                f"ss -ltnp 'sport = :{port}' tells who has it: end that",
            )
        else:
            yield ok(f"port {port} is free for the scene {scene}")
