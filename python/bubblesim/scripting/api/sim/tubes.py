# SPDX-License-Identifier: BSD-3-Clause
"""`sim` functions for tubes, which carry packets between two scripts."""

from __future__ import annotations

from bubblesim.scripting.api.kinds import Bytes
from bubblesim.scripting.api.sim.context import ApiContext


class TubeFunctions(ApiContext):
    """A tube has two ends, which are opened with the same number and name. What one end writes, the other one reads, in
    this order. An end closes with the script that opened it."""

    def tubeOpen(self, header: int, name: str, read_buffer: int = 1, reserved: object = None) -> int:
        """Open an end of a tube and return its handle; ``read_buffer`` packets wait at most."""
        tubes = self._caller.shared.tubes
        handle = tubes.open((header, name), max(1, read_buffer))
        self._caller.at_end["tube", handle] = lambda: tubes.close(handle)
        return handle

    def tubeClose(self, tube: int) -> int:
        """Close an end of a tube; return 1."""
        self._caller.shared.tubes.close(tube)
        self._caller.at_end.pop(("tube", tube), None)
        return 1

    def tubeWrite(self, tube: int, data: Bytes) -> int:
        """Write a packet; return 1, or 0 if the other end is not open."""
        return int(self._caller.shared.tubes.write(tube, data))

    def tubeRead(self, tube: int, blocking: bool = False) -> bytes | None:
        """Return the oldest packet, None (nil) if there is none; ``blocking`` has no effect outside of Lua threads."""
        return self._caller.shared.tubes.read(tube)

    def tubeStatus(self, tube: int) -> tuple[int, int, int]:
        """Return 1 if the other end is open (else 0), and the numbers of packets that wait here and there."""
        return self._caller.shared.tubes.status(tube)
