# SPDX-License-Identifier: BSD-3-Clause
"""Dummies: frames without a body that scripts and programs create at run time."""

from __future__ import annotations

from dataclasses import dataclass, field

from bubblesim.geometry.poses import IDENTITY

FIRST_HANDLE = 0x7FF00000
"""Above the handles of the scene's objects, whose places have at most 2047 generations."""
_MOST = 100_000
_HANDLES = 0xF0000  # above are those of collections


@dataclass
class Dummy:
    """A frame in the scene's tree."""

    handle: int
    name: str
    size: float
    """m, for drawings."""
    temporary: bool
    """It ends with the run in which it was created."""
    parent: int = -1
    """Handle of an object or a dummy; -1 for the world."""
    pose: list[float] = field(default_factory=lambda: list(IDENTITY))
    """In the frame of its parent; of a joint in its moving frame."""
    colours: dict[int, list[float]] = field(default_factory=dict)
    """Red, green, blue from 0 to 1, by colour component."""


class Dummies:
    """The dummies of a simulation by handle, in the order of their creation."""

    def __init__(self) -> None:
        """Create it without dummies."""
        self.by_handle: dict[int, Dummy] = {}
        self._created = 0

    def create(self, name: str, size: float, *, temporary: bool) -> Dummy:
        """Add a dummy at the origin of the world."""
        if len(self.by_handle) >= _MOST:
            raise ValueError(f"a scene has at most {_MOST} dummies: remove some")
        while (handle := FIRST_HANDLE + self._created % _HANDLES) in self.by_handle:
            self._created += 1
        self._created += 1
        dummy = self.by_handle[handle] = Dummy(handle, name, size, temporary)
        return dummy

    def children(self, parent: int) -> list[Dummy]:
        """Return the dummies attached to an object or dummy, or to the world (-1)."""
        return [dummy for dummy in self.by_handle.values() if dummy.parent == parent]

    def remove(self, handle: int) -> None:
        """Remove a dummy and all dummies below it."""
        for child in self.children(handle):
            self.remove(child.handle)
        self.by_handle.pop(handle, None)

    def remove_below(self, parents: set[int]) -> None:
        """Remove the dummies attached to objects that are about to be removed."""
        for dummy in [dummy for dummy in self.by_handle.values() if dummy.parent in parents]:
            self.remove(dummy.handle)

    def end_run(self) -> None:
        """Remove the dummies that were created during the run that has ended."""
        for dummy in [dummy for dummy in self.by_handle.values() if dummy.temporary]:
            self.remove(dummy.handle)
