# SPDX-License-Identifier: BSD-3-Clause
"""Collections: sets of objects, by rules, that proximity sensors and cameras can be limited to."""

from __future__ import annotations

from dataclasses import dataclass, field

FIRST_HANDLE = 0x7FFF0000
"""Above the handles of dummies."""
_MOST = 0xFFFF


@dataclass
class Item:
    """A rule of a collection; it adds objects, or removes those that items before it have added."""

    what: int
    """sim.handle_all, handle_tree, handle_chain or handle_single."""
    handle: int
    """The object that is meant; -1 for all."""
    removes: bool
    without_base: bool
    """The object itself is not meant."""


@dataclass
class Collection:
    """Items in the order in which they were added."""

    temporary: bool
    """It ends with the run in which it was created."""
    items: list[Item] = field(default_factory=list)


class Collections:
    """The collections of a simulation, and which of them each sensor detects."""

    def __init__(self) -> None:
        """Create it without collections."""
        self.by_handle: dict[int, Collection] = {}
        self.detected: dict[int, int] = {}
        """By sensor: the object or collection that it detects; all if it has none."""
        self.by_name: dict[str, int] = {}
        """Those that scripts name."""
        self._created = 0

    def create(self, *, temporary: bool) -> int:
        """Add an empty collection and return its handle."""
        if len(self.by_handle) >= _MOST:
            raise ValueError(f"a scene has at most {_MOST} collections: remove some")
        while (handle := FIRST_HANDLE + self._created % _MOST) in self.by_handle:
            self._created += 1
        self._created += 1
        self.by_handle[handle] = Collection(temporary)
        return handle

    def remove(self, handle: int) -> None:
        """Remove a collection; the sensors that were limited to it detect all objects again."""
        del self.by_handle[handle]
        self.detected = {sensor: entity for sensor, entity in self.detected.items() if entity != handle}

    def end_run(self) -> None:
        """Remove what ends with a run."""
        self.detected.clear()
        for handle in [handle for handle, collection in self.by_handle.items() if collection.temporary]:
            del self.by_handle[handle]
