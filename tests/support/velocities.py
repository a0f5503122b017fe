# SPDX-License-Identifier: BSD-3-Clause
"""Commands of a node on cmd_vel, as a subscriber gets them."""

from pathlib import Path

from ros_peer import Peer
from ros_support import RosCore


class Velocities:
    """Subscribes from its construction on."""

    def __init__(self, core: RosCore, log: Path) -> None:
        self._peer = Peer(core, log)
        self._peer.received("/cmd_vel", "geometry_msgs/Twist")

    def all(self) -> list[tuple[float, float]]:
        """Return forward and turning velocity of each command so far."""
        return [(twist["linear"]["x"], twist["angular"]["z"]) for twist in self._peer.received("/cmd_vel")]

    def last(self) -> tuple[float, float] | None:
        """Return forward and turning velocity of the last command, None before the first."""
        return (self.all() or [None])[-1]

    def close(self) -> None:
        self._peer.close()
