# SPDX-License-Identifier: BSD-3-Clause
"""Dummies: frames without a body, of the scene's file or created at run time by scripts and programs."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field
from typing import Any

_MOST = 100_000
_SIZE = 0.01  # m, of CoppeliaSim's own dummies


@dataclass
class Dummy:
    """What the world does not know of a frame."""

    handle: int
    size: float = _SIZE
    """m, for drawings."""
    temporary: bool = False
    """It ends with the run in which it was created."""
    colours: dict[int, list[float]] = field(default_factory=dict)
    """Red, green, blue from 0 to 1, by colour component."""


class Dummies:
    """The dummies that were created, by handle in the order of their creation."""

    def __init__(self) -> None:
        """Create it without dummies."""
        self.by_handle: dict[int, Dummy] = {}
        self._of_file: dict[int, Dummy] = {}
        self.changed: Callable[[], None] = lambda: None
        """Called after a dummy was created or removed."""

    def create(self, world: Any, name: str, size: float, *, temporary: bool, joint: str = "") -> Dummy:
        """Add a dummy at the origin of the world.

        :param joint: the type of a joint without physics, to add instead: revolute, prismatic or ball.
        """
        if len(self.by_handle) >= _MOST:
            raise ValueError(f"a scene has at most {_MOST} dummies: remove some")
        handle = int(world.add_joint(name, joint) if joint else world.add_dummy(name))
        dummy = self.by_handle[handle] = Dummy(handle, size, temporary)
        self.changed()
        return dummy

    def of(self, handle: int) -> Dummy:
        """Return what is known of a frame; of the file's frames what was set since."""
        return self.by_handle.get(handle) or self._of_file.setdefault(handle, Dummy(handle))

    def remove(self, world: Any, handle: int) -> None:
        """Remove a created dummy and all those below it; other objects below it belong to the world then."""
        for child in world.children(handle):
            if child in self.by_handle:
                self.remove(world, child)
        world.remove_dummy(handle)
        del self.by_handle[handle]
        self.changed()

    def remove_below(self, world: Any, parents: set[int]) -> None:
        """Remove the created dummies that are attached to objects that are about to be removed."""
        for handle in list(self.by_handle):
            if handle in self.by_handle and world.parent(handle) in parents:
                self.remove(world, handle)
        for handle in parents:
            self._of_file.pop(handle, None)

    def end_run(self, world: Any) -> None:
        """Remove the dummies that were created during the run that has ended."""
        for handle, dummy in list(self.by_handle.items()):
            if dummy.temporary and handle in self.by_handle:
                self.remove(world, handle)
