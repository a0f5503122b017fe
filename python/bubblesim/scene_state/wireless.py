# SPDX-License-Identifier: BSD-3-Clause
"""Messages that scripts send to each other without a connection."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field

_MOST = 10_000
_MOST_BYTES = 1 << 20


@dataclass
class WirelessMessage:
    """A message that some scripts can receive, each once."""

    sender: int
    """Handle of the sender's object."""
    header: int
    name: str
    data: str | bytes
    is_for: Callable[[int, int], bool]
    """Whether a script may receive it, by the handle of its object and that of its antenna."""
    until: float
    """Time of the simulation, s, from which it is gone."""
    received: set[int] = field(default_factory=set)
    """Objects whose scripts have received it."""


class Wireless:
    """The messages of a simulation in the order in which they were sent."""

    def __init__(self) -> None:
        """Create it without messages."""
        self._messages: list[WirelessMessage] = []

    def send(self, message: WirelessMessage, now: float) -> None:
        """Keep a message; raise ValueError if it is too large, or there are too many."""
        self._forget(now)
        if len(self._messages) >= _MOST:
            raise ValueError(f"at most {_MOST} messages wait: receive them, or let them persist for a shorter time")
        if len(message.data) > _MOST_BYTES:
            raise ValueError(f"a message of {len(message.data)} bytes: at most {_MOST_BYTES} are accepted")
        self._messages.append(message)

    def waiting(self, now: float, receiver: int, antenna: int) -> list[WirelessMessage]:
        """Return the messages that a script can receive now."""
        self._forget(now)
        return [
            each
            for each in self._messages
            if each.sender != receiver and receiver not in each.received and each.is_for(receiver, antenna)
        ]

    def clear(self) -> None:
        """Forget all messages."""
        self._messages.clear()

    def _forget(self, now: float) -> None:
        self._messages = [each for each in self._messages if now < each.until]
