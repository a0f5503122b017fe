# SPDX-License-Identifier: BSD-3-Clause
"""Tubes between callers: two ends each, with packets that wait."""

from __future__ import annotations

from collections import deque
from dataclasses import dataclass, field

_MOST = 10_000
_MOST_BYTES = 1 << 20  # that wait at an end


@dataclass
class _End:
    key: tuple[int, str]
    room: int
    """Packets that wait at most."""
    other: int = -1
    """Handle of the other end; -1 while it is not open."""
    packets: deque[bytes] = field(default_factory=deque)


class Tubes:
    """The open ends, by handle."""

    def __init__(self) -> None:
        """Create it without tubes."""
        self._ends: dict[int, _End] = {}
        self._opened = 0

    def open(self, key: tuple[int, str], room: int) -> int:
        """Open an end, the other one of a single end with the same key if there is one; return its handle."""
        if len(self._ends) >= _MOST:
            raise ValueError(f"a scene has at most {_MOST} ends of tubes: close some")
        handle, self._opened = self._opened, self._opened + 1
        end = self._ends[handle] = _End(key, room)
        for number, waiting in self._ends.items():
            if number != handle and waiting.key == key and waiting.other < 0:
                end.other, waiting.other = number, handle
                break
        return handle

    def close(self, handle: int) -> None:
        """Close an end; the other one waits for a new partner."""
        end = self._at(handle)
        if end.other >= 0:
            self._ends[end.other].other = -1
        del self._ends[handle]

    def write(self, handle: int, data: bytes) -> bool:
        """Let a packet wait at the other end; return whether it is open."""
        if len(data) > _MOST_BYTES:
            raise ValueError(f"a packet of {len(data)} bytes: at most {_MOST_BYTES} are accepted")
        other = self._ends.get(self._at(handle).other)
        if other is None:
            return False
        other.packets.append(data)
        while len(other.packets) > other.room or sum(map(len, other.packets)) > _MOST_BYTES:
            other.packets.popleft()
        return True

    def read(self, handle: int) -> bytes | None:
        """Return the oldest packet that waits; None if there is none."""
        packets = self._at(handle).packets
        return packets.popleft() if packets else None

    def status(self, handle: int) -> tuple[int, int, int]:
        """Return 1 if the other end is open (else 0), and the numbers of packets that wait at this end and there."""
        end = self._at(handle)
        other = self._ends.get(end.other)
        return int(other is not None), len(end.packets), len(other.packets) if other else 0

    def _at(self, handle: int) -> _End:
        if handle not in self._ends:
            raise LookupError(f"no tube has the handle {handle}")
        return self._ends[handle]
