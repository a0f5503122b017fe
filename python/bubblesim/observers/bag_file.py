# SPDX-License-Identifier: BSD-3-Clause
"""A bag that stays readable when the disk is full."""

from __future__ import annotations

import io
from dataclasses import dataclass
from pathlib import Path

import genpy
import rosbag

from bubblesim import _core
from bubblesim.observers.recorder import Time


class _WholeWrites(io.FileIO):
    """Writes all data at once, or fails without buffering the rest."""

    def write(self, data: bytes | bytearray | memoryview) -> int:  # type: ignore[override]
        """Write all data; raise OSError on failure."""
        left = memoryview(data)
        while left:
            left = left[super().write(left) :]
        return len(data)


class BagFile(rosbag.Bag):  # type: ignore[misc]
    """A bag opened for writing. Written in chunks of at most 768 KiB; after an error, complete ones can be kept."""

    def __init__(self, file: Path) -> None:
        """Open it, replacing an existing file; raise OSError on failure."""
        self._chunk_open = False
        super().__init__(_WholeWrites(file, "w+"), "w")

    def complete_chunk(self) -> None:
        """Complete the chunk in progress: ``rosbag reindex`` restores it if the process is killed; raise OSError."""
        if self._chunk_open:
            self._stop_writing_chunk()

    def close_at_last_chunk(self) -> bool:
        """After an error: drop the incomplete chunk, write the index, and close.

        If there is no space for the index, earlier chunks are dropped, too. Return whether the bag is readable.
        """
        finished = bool(self._chunks) and self._chunks[-1] is self._curr_chunk_info
        if finished and not self._chunk_open:
            end = self._index_data_pos  # the error occurred while writing the index
        else:
            end = self._curr_chunk_info.pos
            if finished:  # the error occurred while closing the chunk
                self._chunks.pop()
        self._chunk_open = False
        self._curr_chunk_connection_indexes.clear()
        while True:
            try:
                self._file.truncate(end)
                self._file.seek(end)
                self.close()
            except OSError:
                if not self._chunks:
                    break
                end = self._chunks.pop().pos
            else:
                return True
        self._close_file()
        return False


@dataclass(frozen=True)
class _Definition:
    """The attributes of a message class that rosbag reads."""

    _md5sum: str
    _full_text: str


class BagRecording:
    """A RecordingFile of ROS 1."""

    def __init__(self, file: Path) -> None:
        """Open the bag, replacing an existing file; raise OSError on failure."""
        self._bag = BagFile(file)
        self._definitions: dict[str, _Definition] = {}
        self.complete_chunk = self._bag.complete_chunk
        self.close = self._bag.close
        self.close_at_last_chunk = self._bag.close_at_last_chunk

    def write(self, topic: str, message_type: str, data: bytes, time: Time) -> None:
        """Write a message; raise OSError on failure."""
        definition = self._definitions.get(message_type)
        if definition is None:
            hash_, text = _core.messages.type_hash(message_type), _core.messages.definition(message_type)
            definition = self._definitions[message_type] = _Definition(hash_, text)
        self._bag.write(topic, (message_type, data, definition._md5sum, definition), genpy.Time(*time), raw=True)
