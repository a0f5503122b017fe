# SPDX-License-Identifier: BSD-3-Clause
"""Writes what scripts publish and hear into a bag."""

from __future__ import annotations

import contextlib
import sys
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import genpy

from bubblesim import _core
from bubblesim.observers.bag_file import BagFile
from bubblesim.output import write_line

_CLOCK = "rosgraph_msgs/Clock"


@dataclass(frozen=True)
class _Definition:
    """What rosbag asks of a message's class."""

    _md5sum: str
    _full_text: str


class BagRecorder:
    """An observer of a bridge.

    All messages of a step bear its time, those that came first, by topic: so that equal runs give equal bags, although
    connections are differently quick.
    """

    def __init__(self, file: Path, bridge: Any) -> None:
        """Open the bag, which takes the place of one of before.

        :raises OSError: when that cannot be done.
        """
        self._bag: BagFile | None = BagFile(file)
        self._file = file
        self._bridge = bridge
        self._definitions: dict[str, _Definition] = {}
        self._heard: list[tuple[str, str, bytes]] = []
        self._published: list[tuple[str, str, bytes, genpy.Time]] = []

    def advertised(self, publisher: int) -> None:
        """Nothing to write."""

    def subscribed(self, topic: str, subscriber: int) -> None:
        """Nothing to write."""

    def published(self, topic: str, message_type: str, message: Any) -> None:
        """Keep it until the step is over."""
        if self._bag is None:
            return
        self._published.append((topic, message_type, _core.messages.encode(message_type, message), self._now()))

    def heard(self, topic: str, message_type: str, message: Any) -> None:
        """Keep it until the step is over."""
        if self._bag is not None:
            self._heard.append((topic, message_type, _core.messages.encode(message_type, message)))

    def input_processed(self) -> None:
        """Nothing to write."""

    def pass_done(self) -> None:
        """Write all of the step, and the time that it had."""
        if self._bag is not None:
            with self._ending_at_an_error():
                self._write_pass(self._bag)
        self._heard.clear()
        self._published.clear()

    @contextlib.contextmanager
    def _ending_at_an_error(self) -> Iterator[None]:
        """The simulation goes on without a bag when there is no room for it."""
        try:
            yield
        except OSError as error:
            bag, self._bag = self._bag, None
            kept = bag is not None and bag.close_at_last_chunk()
            state = "what was written before can be read" if kept else "it cannot be read"
            write_line(sys.stderr, f"error: the recording ends: {self._file}: {error.strerror}; {state}")

    def _write_pass(self, bag: BagFile) -> None:
        sec, nanosec = self._bridge.now()
        clock = _core.messages.encode(_CLOCK, {"clock": {"secs": sec, "nsecs": nanosec}})
        self._heard.sort(key=lambda message: message[0])
        now = self._now()
        of_now = [(*message, now) for message in [("/clock", _CLOCK, clock), *self._heard]]
        for topic, message_type, data, time in [*of_now, *self._published]:
            definition = self._definition(message_type)
            bag.write(topic, (message_type, data, definition._md5sum, definition), time, raw=True)

    def _now(self) -> genpy.Time:
        sec, nanosec = self._bridge.now()
        return genpy.Time(sec, max(nanosec, 1) if sec == 0 else nanosec)  # a bag knows no time 0

    def close(self) -> None:
        """Write the bag's index, without which it cannot be read."""
        if self._bag is not None:
            with self._ending_at_an_error():
                self._bag.close()

    def _definition(self, message_type: str) -> _Definition:
        if message_type not in self._definitions:
            text = _core.messages.definition(message_type)
            self._definitions[message_type] = _Definition(_core.messages.md5(message_type), text)
        return self._definitions[message_type]
