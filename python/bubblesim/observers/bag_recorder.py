# SPDX-License-Identifier: BSD-3-Clause
"""Records the messages of scripts to a bag."""

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
from bubblesim.program.output import write_line

_CLOCK = "rosgraph_msgs/Clock"
_Message = tuple[str, str, bytes, genpy.Time]  # topic, type, content, time


@dataclass(frozen=True)
class _Definition:
    """The attributes of a message class that rosbag reads."""

    _md5sum: str
    _full_text: str


class BagRecorder:
    """An observer of a bridge.

    Messages are stamped with ROS time when they were received or published: in simulated time with the start of the
    step, those published after the physics and /clock with its end. At each time, received messages are written first,
    sorted by topic, and then /clock. So equal runs write equal bags, independent of the delays of connections.

    A chunk is completed in each second of ROS time, not of wall time, which would make equal runs different: if the
    simulator is killed, ``rosbag reindex`` restores all but the last second.
    """

    def __init__(self, file: Path, bridge: Any) -> None:
        """Open the bag, replacing an existing file.

        :raises OSError: if that fails.
        """
        self._bag: BagFile | None = BagFile(file)
        self._file = file
        self._bridge = bridge
        self._definitions: dict[str, _Definition] = {}
        self._received: list[_Message] = []
        self._published: list[_Message] = []
        self._second = 0  # of the chunk in progress

    def advertised(self, publisher: int) -> None:
        """Do nothing."""

    def subscribed(self, topic: str, subscriber: int) -> None:
        """Do nothing."""

    def published(self, topic: str, message_type: str, message: Any) -> None:
        """Store the message until the end of the step."""
        if self._bag is not None:
            self._published.append(self._message(topic, message_type, message))

    def received(self, topic: str, message_type: str, message: Any) -> None:
        """Store the message until the end of the step."""
        if self._bag is not None:
            self._received.append(self._message(topic, message_type, message))

    def _message(self, topic: str, message_type: str, message: Any) -> _Message:
        return topic, message_type, _core.messages.encode(message_type, message), self._now()

    def input_processed(self) -> None:
        """Do nothing."""

    def step_done(self) -> None:
        """Write the messages of the step, and the time at its end."""
        if self._bag is not None:
            with self._stopped_on_error():
                self._write_step(self._bag)
        self._received.clear()
        self._published.clear()

    @contextlib.contextmanager
    def _stopped_on_error(self) -> Iterator[None]:
        """Continue without a bag if writing fails."""
        try:
            yield
        except OSError as error:
            bag, self._bag = self._bag, None
            kept = bag is not None and bag.close_at_last_chunk()
            state = "the file contains the messages before" if kept else "the file is not readable"
            write_line(sys.stderr, f"error: recording stopped: {self._file}: {error.strerror}; {state}")

    def _write_step(self, bag: BagFile) -> None:
        sec, nanosec = self._bridge.now()
        clock = self._message("/clock", _CLOCK, {"clock": {"secs": sec, "nsecs": nanosec}})
        self._received.sort(key=lambda message: message[0])
        messages = sorted([*self._received, clock, *self._published], key=lambda message: message[3])
        for topic, message_type, data, time in messages:
            definition = self._definition(message_type)
            bag.write(topic, (message_type, data, definition._md5sum, definition), time, raw=True)
        if sec != self._second:
            bag.complete_chunk()
            self._second = sec

    def _now(self) -> genpy.Time:
        sec, nanosec = self._bridge.now()
        return genpy.Time(sec, max(nanosec, 1) if sec == 0 else nanosec)  # bags do not allow time 0

    def close(self) -> None:
        """Close the bag; this writes its index."""
        if self._bag is not None:
            with self._stopped_on_error():
                self._bag.close()

    def _definition(self, message_type: str) -> _Definition:
        if message_type not in self._definitions:
            text = _core.messages.definition(message_type)
            self._definitions[message_type] = _Definition(_core.messages.type_hash(message_type), text)
        return self._definitions[message_type]
