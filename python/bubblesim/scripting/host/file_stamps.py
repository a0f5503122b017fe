# SPDX-License-Identifier: BSD-3-Clause
"""Detection of edited files."""

from __future__ import annotations

from pathlib import Path

_Stamp = tuple[int, int, int]


class FileStamps:
    """Inode, size and time stamp of files."""

    def __init__(self) -> None:
        """Know no files yet."""
        self._before: dict[Path, _Stamp | None] = {}

    def note(self, file: Path) -> None:
        """Store the state of a file. Call it before reading: later, the file may have changed again."""
        self._before.setdefault(file, _stamp(file))

    def differ(self) -> bool:
        """Return whether a file has changed. Missing files are ignored: editors replace files."""
        return any((now := _stamp(file)) is not None and now != before for file, before in self._before.items())


def _stamp(file: Path) -> _Stamp | None:
    try:
        found = file.stat()
    except OSError:
        return None
    return found.st_ino, found.st_size, found.st_mtime_ns
