# SPDX-License-Identifier: BSD-3-Clause
"""Named values that callers store for each other, such as signals, of limited number and size."""

from __future__ import annotations

import sys
from collections.abc import Hashable, Iterator, MutableMapping
from typing import Any, TypeVar

MOST_VALUES = 100_000
MOST_BYTES = 128 * 1024 * 1024

Key = TypeVar("Key", bound=Hashable)


class StoredValues(MutableMapping[Key, Any]):
    """Values by key, which have the limits together."""

    def __init__(self, what: str) -> None:
        """Create it empty.

        :param what: how errors name the values, such as "signals".
        """
        self._what = what
        self._values: dict[Key, Any] = {}
        self._sizes: dict[Key, int] = {}
        self._bytes = 0

    def __getitem__(self, key: Key) -> Any:
        """Return a value; raise KeyError if there is none."""
        return self._values[key]

    def __setitem__(self, key: Key, value: Any) -> None:
        """Store a value instead of the one before; raise ValueError if it does not fit."""
        before = self._sizes.get(key, 0)
        if not before and len(self._values) >= MOST_VALUES:
            raise ValueError(f"the scene already has {MOST_VALUES} {self._what}, the most that it can hold: clear some")
        room = MOST_BYTES - self._bytes + before
        size = _size((key, value), room)
        if size > room:
            raise ValueError(
                f"the {self._what} of the scene would have more than {MOST_BYTES >> 20} MiB together, the most that it "
                f"can hold; {(self._bytes - before) / (1 << 20):.1f} MiB are in use by others: clear some"
            )
        self._values[key] = value
        self._sizes[key] = size
        self._bytes += size - before

    def __delitem__(self, key: Key) -> None:
        """Remove a value; raise KeyError if there is none."""
        del self._values[key]
        self._bytes -= self._sizes.pop(key)

    def __iter__(self) -> Iterator[Key]:
        """Return the keys in the order in which they were first stored."""
        return iter(self._values)

    def __len__(self) -> int:
        """Return the number of values."""
        return len(self._values)

    def clear(self) -> None:
        """Remove all values."""
        self._values.clear()
        self._sizes.clear()
        self._bytes = 0


def _size(value: object, most: int) -> int:
    """Return the bytes of memory of a value with all in it; a number above ``most`` may be too small."""
    size = 0
    rest = [value]
    while rest and size <= most:  # ends for what contains itself, too
        each = rest.pop()
        size += 0 if isinstance(each, type) else sys.getsizeof(each)  # a type in a key is there in any case
        if isinstance(each, dict):
            rest += each.keys()
            rest += each.values()
        elif isinstance(each, list | tuple | set):
            rest += each
    return size
