# SPDX-License-Identifier: BSD-3-Clause
"""Records the messages of scripts to a file."""

from __future__ import annotations

import contextlib
import sys
from collections.abc import Iterator
from pathlib import Path
from typing import Any, Protocol

from bubblesim import _core
from bubblesim.program.output import write_line

_CLOCK = "rosgraph_msgs/Clock"
Time = tuple[int, int]  # sec, nanosec
_Message = tuple[str, str, bytes, Time]  # topic, type, content, time


class RecordingFile(Protocol):
    """A bag, or a file of ROS 2."""

    def write(self, topic: str, message_type: str, data: bytes, time: Time) -> None:
        """Write a message; raise OSError on failure."""

    def complete_chunk(self) -> None:
        """Make what was written readable if the process is killed; raise OSError on failure."""

    def close(self) -> None:
        """Write the index, and close."""

    def close_at_last_chunk(self) -> bool:
        """After an error: drop the incomplete chunk and close; return whether the file is readable."""


class Recorder:
    """An observer of a bridge.

    Messages are stamped with ROS time when they were received or published: in simulated time with the start of the
    step, those published after the physics and /clock with its end. At each time, received messages are written first,
    sorted by topic, and then /clock. So equal runs write equal files, independent of the delays of connections.

    A chunk is completed in each second of ROS time, not of wall time, which would make equal runs different: if the
    simulator is killed, all but the last second can be restored.
    """

    def __init__(self, path: Path, file: RecordingFile, bridge: Any) -> None:
        """Write to an open file; ``path`` is for errors."""
        self._file: RecordingFile | None = file
        self._path = path
        self._bridge = bridge
        is_ros2 = bridge.version == _core.messages.RosVersion.ROS2
        self._encode = _core.messages.encode_ros2 if is_ros2 else _core.messages.encode
        self._received: list[_Message] = []
        self._published: list[_Message] = []
        self._second = 0  # of the chunk in progress

    def advertised(self, publisher: int) -> None:
        """Do nothing."""

    def subscribed(self, topic: str, subscriber: int) -> None:
        """Do nothing."""

    def published(self, topic: str, message_type: str, message: Any) -> None:
        """Store the message until the end of the step."""
        if self._file is not None:
            self._published.append(self._message(topic, message_type, message))

    def received(self, topic: str, message_type: str, message: Any) -> None:
        """Store the message until the end of the step."""
        if self._file is not None:
            self._received.append(self._message(topic, message_type, message))

    def _message(self, topic: str, message_type: str, message: Any) -> _Message:
        return topic, message_type, self._encode(message_type, message), self._now()

    def input_processed(self) -> None:
        """Do nothing."""

    def step_done(self) -> None:
        """Write the messages of the step, and the time at its end."""
        if self._file is not None:
            with self._stopped_on_error():
                self._write_step(self._file)
        self._received.clear()
        self._published.clear()

    @contextlib.contextmanager
    def _stopped_on_error(self) -> Iterator[None]:
        """Continue without a file if writing fails."""
        try:
            yield
        except OSError as error:
            file, self._file = self._file, None
            kept = file is not None and file.close_at_last_chunk()
            state = "the file contains the messages before" if kept else "the file is not readable"
            write_line(sys.stderr, f"error: recording stopped: {self._path}: {error.strerror}; {state}")

    def _write_step(self, file: RecordingFile) -> None:
        sec, nanosec = self._bridge.now()
        clock = self._message("/clock", _CLOCK, {"clock": {"secs": sec, "nsecs": nanosec}})
        self._received.sort(key=lambda message: message[0])
        for message in sorted([*self._received, clock, *self._published], key=lambda message: message[3]):
            file.write(*message)
        if sec != self._second:
            file.complete_chunk()
            self._second = sec

    def _now(self) -> Time:
        sec, nanosec = self._bridge.now()
        return (sec, max(nanosec, 1) if sec == 0 else nanosec)  # bags do not allow time 0

    def close(self) -> None:
        """Close the file; this writes its index."""
        if self._file is not None:
            with self._stopped_on_error():
                self._file.close()
