# SPDX-License-Identifier: BSD-3-Clause
"""The calls of remote clients that are answered later: after a step, a command, or a time."""

from __future__ import annotations

from collections.abc import Callable

from bubblesim.remote import protocol
from bubblesim.remote.alarm import Alarm
from bubblesim.remote.remote_client import Line, Pending


class WaitingCalls:
    """By the identity of their line. All methods are for the simulating thread."""

    def __init__(self, answer: Callable[[Line], None], wake: Callable[[], None]) -> None:
        """Begin without calls.

        :param answer: sends the reply of a line.
        :param wake: called in another thread when a time has passed; ``answer_due`` must follow.
        """
        self._answer = answer
        self._lines: dict[bytes, Line] = {}  # those with a pending call; perhaps some others
        self._alarm = Alarm(wake)

    def add(self, line: Line, pending: Pending) -> None:
        """Let the call of a line wait."""
        line.pending = pending
        self._lines[line.identity] = line
        if pending.due is not None:
            self._alarm.set(pending.due)

    def discard(self, line: Line) -> None:
        """Forget the call of a line that is gone."""
        self._lines.pop(line.identity, None)

    def answer_done(self) -> None:
        """Answer the calls that need not wait any more."""
        for line in list(self._lines.values()):
            if self.settle(line):
                self._answer(line)

    def answer_due(self) -> None:
        """Answer likewise, and wait for the next time."""
        self.answer_done()
        for line in self._lines.values():
            if line.pending is not None and line.pending.due is not None:
                self._alarm.set(line.pending.due)

    def settle(self, line: Line) -> bool:
        """Turn a pending call into its reply if it is done."""
        pending = line.pending
        try:
            if pending is not None and not pending.is_done():
                return False
            self._lines.pop(line.identity, None)
            if pending is None:
                return False
            line.reply = protocol.result(pending.result())
        except Exception as error:
            self._lines.pop(line.identity, None)
            line.reply = protocol.error_of(error)
        line.pending = None
        return True

    def close(self) -> None:
        """Stop waiting for times."""
        self._alarm.close()
