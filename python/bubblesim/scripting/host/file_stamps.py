# SPDX-License-Identifier: BSD-3-Clause
"""Notices that files were edited."""

from __future__ import annotations

from collections.abc import Iterable
from pathlib import Path

_Stamp = tuple[int, int, int]


class FileStamps:
    """What tells files from edited ones."""

    def __init__(self, files: Iterable[Path]) -> None:
        """Look at them as they are now."""
        self._before = {file: _stamp(file) for file in files}

    def differ(self) -> bool:
        """Whether a file is another one than it was. One that is not there is about to come: editors do so."""
        return any((now := _stamp(file)) is not None and now != before for file, before in self._before.items())


def _stamp(file: Path) -> _Stamp | None:
    try:
        found = file.stat()
    except OSError:
        return None
    return found.st_ino, found.st_size, found.st_mtime_ns
