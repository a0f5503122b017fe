# SPDX-License-Identifier: BSD-3-Clause
"""Writes MCAP, the files in which ROS 2 records messages (https://mcap.dev/spec), without compression."""

from __future__ import annotations

import os
import struct
from pathlib import Path

from bubblesim import _core
from bubblesim.observers.recorder import Time

_MAGIC = b"\x89MCAP0\r\n"
_HEADER, _FOOTER, _SCHEMA, _CHANNEL, _MESSAGE, _STATISTICS, _DATA_END = 1, 2, 3, 4, 5, 11, 15
_CDR_HEADER = b"\0\1\0\0"


def _text(text: str) -> bytes:
    data = text.encode("utf-8", errors="surrogateescape")
    return struct.pack("<I", len(data)) + data


def _record(kind: int, content: bytes) -> bytes:
    return struct.pack("<BQ", kind, len(content)) + content


class McapRecording:
    """A RecordingFile of ROS 2: `ros2 bag play` and Foxglove read it."""

    def __init__(self, file: Path) -> None:
        """Open it, replacing an existing file; raise OSError on failure."""
        self._file = os.open(file, os.O_WRONLY | os.O_CREAT | os.O_TRUNC, 0o666)
        self._written = 0  # bytes that are complete in the file
        self._waiting: list[bytes] = [_MAGIC, _record(_HEADER, _text("ros2") + _text("bubblesim"))]
        self._schemas: dict[str, bytes] = {}  # records by type
        self._channels: dict[str, tuple[int, bytes]] = {}  # id and record by topic
        self._counts: dict[int, int] = {}  # messages by channel
        self._times = (0, 0)  # ns, first and last

    def write(self, topic: str, message_type: str, data: bytes, time: Time) -> None:
        """Keep a message until the chunk is completed."""
        channel = self._channel(topic, message_type)
        stamp = time[0] * 1_000_000_000 + time[1]
        self._times = (self._times[0] or stamp, stamp)
        self._counts[channel] += 1
        content = struct.pack("<HIQQ", channel, self._counts[channel], stamp, stamp) + _CDR_HEADER + data
        self._waiting.append(_record(_MESSAGE, content))

    def complete_chunk(self) -> None:
        """Write what waits; raise OSError on failure."""
        left = memoryview(b"".join(self._waiting))
        size = len(left)
        while left:
            left = left[os.write(self._file, left) :]
        self._waiting.clear()
        self._written += size

    def close(self) -> None:
        """Write the summary, and close; raise OSError on failure."""
        self._waiting.append(_record(_DATA_END, struct.pack("<I", 0)))
        start = self._written + sum(map(len, self._waiting))
        self._waiting += [*self._schemas.values(), *(record for _, record in self._channels.values())]
        counts = b"".join(struct.pack("<HQ", channel, count) for channel, count in self._counts.items())
        totals = sum(self._counts.values()), len(self._schemas), len(self._channels), 0, 0, 0, *self._times
        statistics = struct.pack("<QHIIIIQQI", *totals, len(counts)) + counts
        self._waiting += [_record(_STATISTICS, statistics), _record(_FOOTER, struct.pack("<QQI", start, 0, 0)), _MAGIC]
        self.complete_chunk()
        os.close(self._file)

    def close_at_last_chunk(self) -> bool:
        """After an error: drop the incomplete chunk, and close without a summary; return whether it is readable."""
        end = _record(_DATA_END, struct.pack("<I", 0)) + _record(_FOOTER, struct.pack("<QQI", 0, 0, 0)) + _MAGIC
        try:
            os.ftruncate(self._file, self._written)
            os.lseek(self._file, 0, os.SEEK_END)
            readable = os.write(self._file, end) == len(end)
        except OSError:
            readable = False
        os.close(self._file)
        return readable and self._written > 0

    def _channel(self, topic: str, message_type: str) -> int:
        known = self._channels.get(topic)
        if known is not None:
            return known[0]
        if message_type not in self._schemas:
            definition = _core.messages.definition(message_type, _core.messages.RosVersion.ROS2)
            package, _, name = message_type.partition("/")
            full_name = message_type if "/" in name else f"{package}/msg/{name}"
            schema = struct.pack("<H", len(self._schemas) + 1) + _text(full_name) + _text("ros2msg") + _text(definition)
            self._schemas[message_type] = _record(_SCHEMA, schema)
            self._waiting.append(self._schemas[message_type])
        number = len(self._channels) + 1
        schema_number = list(self._schemas).index(message_type) + 1
        channel = struct.pack("<HH", number, schema_number) + _text(topic) + _text("cdr") + struct.pack("<I", 0)
        self._channels[topic] = number, _record(_CHANNEL, channel)
        self._counts[number] = 0
        self._waiting.append(self._channels[topic][1])
        return number
