# SPDX-License-Identifier: BSD-3-Clause
"""The error for a number that is not the handle of an object."""

from __future__ import annotations

MAX_HANDLE = 2**31 - 1


class HandleError(ValueError):
    """A number that is not a handle of an object."""

    def __init__(self, handle: int, where: str = "") -> None:
        """:param where: beginning of the text."""
        none = "; sim.getObject with noError returns it for a missing object" if handle == -1 else ""
        super().__init__(f"{where}{handle} is not a handle of an object{none}")
        self.handle = handle
