# SPDX-License-Identifier: BSD-3-Clause
"""A bag that stays readable when there is no room for more of it."""

from __future__ import annotations

import io
from pathlib import Path

import rosbag


class _WholeWrites(io.FileIO):
    """Writes all that it is given, or fails and keeps nothing back to be written later."""

    def write(self, data: bytes | bytearray | memoryview) -> int:  # type: ignore[override]
        """Write all of it; OSError when that cannot be done."""
        left = memoryview(data)
        while left:
            left = left[super().write(left) :]
        return len(data)


class BagFile(rosbag.Bag):  # type: ignore[misc]
    """A bag to write. Messages come in chunks of 768 KiB; after an error, those of the chunks before can be kept."""

    def __init__(self, file: Path) -> None:
        """Open it, in the place of one of before; OSError when that cannot be done."""
        self._chunk_open = False
        super().__init__(_WholeWrites(file, "w+"), "w")

    def close_at_last_chunk(self) -> bool:
        """After an error: leave out the chunk that is not finished, write the index, and close.

        Where the index does not fit, chunks before are left out, too. Whether the bag can be read.
        """
        finished = bool(self._chunks) and self._chunks[-1] is self._curr_chunk_info
        if finished and not self._chunk_open:
            end = self._index_data_pos  # the error came while the index was written
        else:
            end = self._curr_chunk_info.pos
            if finished:  # it came while the chunk was ended
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
