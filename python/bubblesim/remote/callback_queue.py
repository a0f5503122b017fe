# SPDX-License-Identifier: BSD-3-Clause
"""The callbacks that wait for a remote client."""

from __future__ import annotations

from collections import deque

_MOST_CALLBACKS = 1000
_MOST_CALLBACK_BYTES = 16 * 1024 * 1024


class CallbackQueue:
    """Calls of a client's functions, as messages, until it waits for a reply. The oldest are dropped."""

    def __init__(self) -> None:
        """Create it empty."""
        self._messages: deque[bytes] = deque()
        self._bytes = 0

    def __len__(self) -> int:
        """Return the number of calls."""
        return len(self._messages)

    def put(self, message: bytes) -> None:
        """Add a call."""
        self._messages.append(message)
        self._bytes += len(message)
        while len(self._messages) > _MOST_CALLBACKS or (self._bytes > _MOST_CALLBACK_BYTES and len(self._messages) > 1):
            self.take()

    def take(self) -> bytes:
        """Remove the oldest call and return it."""
        message = self._messages.popleft()
        self._bytes -= len(message)
        return message

    def clear(self) -> None:
        """Remove all calls."""
        self._messages.clear()
        self._bytes = 0
