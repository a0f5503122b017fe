# SPDX-License-Identifier: BSD-3-Clause
"""The tree of objects as scripts see it: the objects of the scene, and dummies below them."""

from __future__ import annotations

import re
from collections.abc import Sequence
from fnmatch import fnmatchcase
from typing import Any

from bubblesim.geometry import poses
from bubblesim.scripting.api.kinds import HandleError
from bubblesim.scripting.dummies import FIRST_HANDLE, Dummies, Dummy

_INDEXED = re.compile(r"(.*?)(?:\[(\d+)\])?")


class ObjectTree:
    """Functions of ``World`` that also accept dummies. -1 is the world."""

    def __init__(self, world: Any, dummies: Dummies) -> None:
        """Combine the tree of a world with the dummies."""
        self._world = world
        self._dummies = dummies

    def dummy(self, handle: int) -> Dummy:
        """Return a dummy; raise HandleError if there is none."""
        try:
            return self._dummies.by_handle[handle]
        except KeyError:
            raise HandleError(handle) from None

    def contains(self, handle: int) -> bool:
        """Return whether this is the handle of an object or dummy."""
        if handle >= FIRST_HANDLE:
            return handle in self._dummies.by_handle
        try:
            self._world.kind(handle)
        except LookupError:
            return False
        return True

    def kind(self, handle: int) -> str:
        """Return 'model', 'link', 'joint', 'sensor' or 'dummy'."""
        if handle >= FIRST_HANDLE:
            self.dummy(handle)
            return "dummy"
        return str(self._world.kind(handle))

    def name(self, handle: int) -> str:
        """Return the name without an index."""
        return self.dummy(handle).name if handle >= FIRST_HANDLE else str(self._world.name(handle))

    def parent(self, handle: int) -> int:
        """Return the parent, -1 at the top."""
        return self.dummy(handle).parent if handle >= FIRST_HANDLE else int(self._world.parent(handle))

    def children(self, handle: int) -> list[int]:
        """Return the children; those of -1 are the objects at the top."""
        found: list[int] = []
        if handle < 0:
            found = [int(model) for model in self._world.models if int(self._world.parent(model)) < 0]
        elif handle < FIRST_HANDLE:
            found = [int(child) for child in self._world.children(handle)]
        if self._dummies.by_handle:
            found += [dummy.handle for dummy in self._dummies.children(handle)]
        return found

    def path(self, handle: int) -> str:
        """Return the full path."""
        if handle < FIRST_HANDLE:
            return str(self._world.path(handle))
        dummy = self.dummy(handle)
        named = [each.handle for each in self._dummies.children(dummy.parent) if each.name == dummy.name]
        index = f"[{named.index(handle)}]" if len(named) > 1 else ""
        return f"{self.path(dummy.parent) if dummy.parent >= 0 else ''}/{dummy.name}{index}"

    def short_path(self, handle: int) -> str:
        """Return the shortest path that is unique in the scene; of a dummy its full path."""
        return self.path(handle) if handle >= FIRST_HANDLE else str(self._world.short_path(handle))

    def find(self, path: str, start: int, index: int = 0) -> int:
        """Return the object at a path, see ``World.find``, or else the dummy; raise LookupError if there is none."""
        dummies = self._dummies.by_handle
        if not dummies:
            return int(self._world.find(path, start, index))
        if start >= FIRST_HANDLE:
            path, start = self._from_parent(path, start)
        try:
            return int(self._world.find(path, start, index))
        except LookupError:
            found = [handle for handle in dummies if self._matches(handle, path, start)]
            if index < len(found):
                return found[index]
            raise

    def pose(self, handle: int) -> list[float]:
        """Return the pose in the world."""
        if handle < FIRST_HANDLE:
            return list(self._world.pose(handle))
        dummy = self.dummy(handle)
        return dummy.pose[:] if dummy.parent < 0 else self._out_of(dummy.parent, dummy.pose)

    def pose_in(self, handle: int, frame: int) -> list[float]:
        """Return the pose in the frame of another object."""
        if handle < FIRST_HANDLE and frame < FIRST_HANDLE:
            return list(self._world.pose_in(handle, frame))
        if handle >= FIRST_HANDLE and self.dummy(handle).parent == frame:
            return self.dummy(handle).pose[:]
        return self._into(frame, self.pose(handle))

    def set_pose(self, handle: int, pose: Sequence[float], frame: int = -1) -> None:
        """Set the pose in the world (-1) or in the frame of another object."""
        if handle < FIRST_HANDLE and frame < 0:
            self._world.set_pose(handle, pose)
            return
        if handle < FIRST_HANDLE and frame < FIRST_HANDLE:
            self._world.set_pose_in(handle, pose, frame)
            return
        if handle < FIRST_HANDLE:
            self._world.set_pose(handle, self._out_of(frame, pose))
            return
        dummy = self.dummy(handle)
        if dummy.parent == frame:
            dummy.pose = list(pose)
        else:
            in_world = pose if frame < 0 else self._out_of(frame, pose)
            dummy.pose = list(in_world) if dummy.parent < 0 else self._into(dummy.parent, in_world)

    def set_parent(self, handle: int, parent: int, *, in_place: bool) -> None:
        """Attach a dummy to an object, to another dummy, or to the world (-1)."""
        dummy = self.dummy(handle)
        above = parent
        while above >= FIRST_HANDLE:
            if above == handle:
                raise ValueError(f"{self.path(handle)} cannot be attached to itself or to what is attached to it")
            above = self.dummy(above).parent
        if parent >= 0:
            self.kind(parent)  # raises
        pose = self.pose(handle)
        dummy.parent = parent
        if in_place:
            self.set_pose(handle, pose)

    def _out_of(self, frame: int, pose: Sequence[float]) -> list[float]:
        if frame < FIRST_HANDLE:
            return list(self._world.pose_from(pose, frame))
        return poses.multiply(self.pose(frame), pose)

    def _into(self, frame: int, pose: Sequence[float]) -> list[float]:
        if frame < FIRST_HANDLE:
            return list(self._world.pose_to(pose, frame))
        return poses.multiply(poses.inverse(self.pose(frame)), pose)

    def _from_parent(self, path: str, dummy: int) -> tuple[str, int]:
        """Return a path that starts at a dummy as one that starts at the nearest object above it."""
        while path.startswith("../") or path == "..":
            dummy, path = self.parent(dummy), path[3:]
            if dummy < FIRST_HANDLE:
                return (f"./{path}" if path else "."), dummy
        if path.startswith("."):
            return self.path(dummy) + path[1:], -1
        while dummy >= FIRST_HANDLE:
            dummy = self.parent(dummy)
        return path, dummy

    def _matches(self, handle: int, path: str, start: int) -> bool:
        """Return whether a path leads to a dummy; it may omit levels."""
        anchor, _, rest = path.partition("/")
        top = -1
        if anchor == ".":
            top = start
        elif anchor == "..":
            top = self.parent(start) if start >= 0 else -1
        elif anchor == ":":
            top = int(self._world.model_of(start)) if start >= 0 else -1
        elif anchor:
            return False
        wanted = [part for part in rest.split("/") if part]
        level = handle
        first = True
        while wanted and level >= 0 and level != top:
            name, index = _INDEXED.fullmatch(wanted[-1]).groups()  # type: ignore[union-attr]
            siblings = [each for each in self.children(self.parent(level)) if fnmatchcase(self.name(each), name)]
            fits = level in siblings and (index is None or siblings.index(level) == int(index))
            if fits:
                wanted.pop()
            elif first:
                return False
            first = False
            level = self.parent(level)
        above = level
        while above >= 0 and above != top:
            above = self.parent(above)
        return not wanted and not first and above == top
