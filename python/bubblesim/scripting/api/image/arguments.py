# SPDX-License-Identifier: BSD-3-Clause
"""Arguments of `simIM`, which has points and colours as tables, and in older versions as single numbers."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any


class Rest:
    """The arguments that are not read yet, from the first one."""

    def __init__(self, arguments: Sequence[Any]) -> None:
        """Begin with the first one."""
        self._left = list(arguments)

    def point(self) -> tuple[int, int]:
        """Return x and y: of a table, or the next two numbers."""
        x, y = self._numbers(2, "a point has x and y")
        return int(x), int(y)

    def number(self, default: float) -> float:
        """Return the next number, or a default."""
        return float(self._left.pop(0)) if self._left and self._left[0] is not None else self._skip(default)

    def colour(self) -> tuple[int, int, int]:
        """Return red, green and blue from 0 to 255: of a table, or the next three numbers; white without any."""
        if not self._left or self._left[0] is None:
            return 255, 255, 255
        red, green, blue = self._numbers(3, "a colour has red, green and blue")
        return int(red), int(green), int(blue)

    def _numbers(self, count: int, words: str) -> list[float]:
        if self._left and isinstance(self._left[0], list | tuple):
            found = [float(number) for number in self._left.pop(0)]
        else:
            found = [float(number) for number in self._left[:count]]
            del self._left[:count]
        if len(found) < count:
            raise TypeError(f"simIM: {words}, found {found}")
        return found[:count]

    def _skip(self, default: float) -> float:
        if self._left:
            self._left.pop(0)
        return default
