# SPDX-License-Identifier: BSD-3-Clause
"""The tree of objects as scripts see it: the objects of the scene, and dummies below them."""

from __future__ import annotations

import re
from collections.abc import Sequence
from fnmatch import fnmatchcase
from typing import Any

from bubblesim._core import ObjectFrames
from bubblesim.geometry import poses
from bubblesim.scene_state.dummies import FIRST_HANDLE, Dummies, Dummy
from bubblesim.scene_state.handle_error import HandleError
from bubblesim.scene_state.scene_edits import SceneEdits, relative

_INDEXED = re.compile(r"(.*?)(?:\[(\d+)\])?")


class ObjectTree:
    """Functions of ``World`` and ``ObjectFrames`` that also accept dummies, with changed names and parents. -1 is the
    world."""

    def __init__(self, world: Any, dummies: Dummies, edits: SceneEdits) -> None:
        """Combine the tree of a world with the dummies and changes."""
        self._world = world
        self._frames = ObjectFrames(world)
        self._dummies = dummies
        self._edits = edits

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
        if handle >= FIRST_HANDLE:
            return self.dummy(handle).name
        return self._edits.names.get(handle) or str(self._world.alias(handle))

    def parent(self, handle: int) -> int:
        """Return the parent, -1 at the top."""
        if handle >= FIRST_HANDLE:
            return self.dummy(handle).parent
        return (
            self._edits.parents.get(handle, -1)
            if self._edits.parents and self._is_outermost(handle)
            else int(self._world.parent(handle))
        )

    def children(self, handle: int) -> list[int]:
        """Return the children; those of -1 are the objects at the top."""
        found: list[int] = []
        parents = self._edits.parents
        if handle < 0:
            found = [int(model) for model in self._world.models if self._is_outermost(model) and model not in parents]
        elif handle < FIRST_HANDLE:
            found = [int(child) for child in self._world.children(handle)]
        if parents and handle >= 0:
            found += [model for model, parent in parents.items() if parent == handle]
        if self._dummies.by_handle:
            found += [dummy.handle for dummy in self._dummies.children(handle)]
        return found

    def path(self, handle: int) -> str:
        """Return the full path."""
        if handle < FIRST_HANDLE and not self._is_edited():
            return str(self._world.path(handle))
        name, parent = self.name(handle), self.parent(handle)
        named = [each for each in self.children(parent) if self.name(each) == name]
        index = f"[{named.index(handle)}]" if len(named) > 1 else ""
        return f"{self.path(parent) if parent >= 0 else ''}/{name}{index}"

    def short_path(self, handle: int) -> str:
        """Return the shortest path that is unique in the scene; of a dummy, and in a changed tree, the full path."""
        is_own = handle < FIRST_HANDLE and not self._is_edited()
        return str(self._world.short_path(handle)) if is_own else self.path(handle)

    def find(self, path: str, start: int, index: int = 0) -> int:
        """Return the object at a path, see ``World.find``, or else the dummy; raise LookupError if there is none."""
        if self._is_edited():
            return self._search(path, start, index)
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
            pose: list[float] = self._frames.pose(handle)
            return pose
        dummy = self.dummy(handle)
        return dummy.pose[:] if dummy.parent < 0 else self._out_of(dummy.parent, dummy.pose)

    def pose_in(self, handle: int, frame: int) -> list[float]:
        """Return the pose in the frame of another object."""
        if handle < FIRST_HANDLE and frame < FIRST_HANDLE:
            return list(self._frames.pose_in(handle, frame))
        if handle >= FIRST_HANDLE and self.dummy(handle).parent == frame:
            return self.dummy(handle).pose[:]
        return self._into(frame, self.pose(handle))

    def set_pose(self, handle: int, pose: Sequence[float], frame: int = -1) -> None:
        """Set the pose in the world (-1) or in the frame of another object; what is attached moves along."""
        attached = [(model, self._into(handle, self.pose(model))) for model in self._attached_to(handle)]
        self._set_own_pose(handle, pose, frame)
        for model, relative_pose in attached:
            self._world.set_pose(model, self._out_of(handle, relative_pose))
            self._pose_changed(model)
        self._pose_changed(handle)

    def _set_own_pose(self, handle: int, pose: Sequence[float], frame: int) -> None:
        if handle < FIRST_HANDLE and frame < 0:
            self._frames.set_pose(handle, pose)
            return
        if handle < FIRST_HANDLE and frame < FIRST_HANDLE:
            self._frames.set_pose_in(handle, pose, frame)
            return
        if handle < FIRST_HANDLE:
            self._frames.set_pose(handle, self._out_of(frame, pose))
            return
        dummy = self.dummy(handle)
        if dummy.parent == frame:
            dummy.pose = list(pose)
        else:
            in_world = pose if frame < 0 else self._out_of(frame, pose)
            dummy.pose = list(in_world) if dummy.parent < 0 else self._into(dummy.parent, in_world)

    def set_parent(self, handle: int, parent: int, *, in_place: bool) -> None:
        """Attach a dummy or an outermost model to an object, to a dummy, or to the world (-1)."""
        above = parent
        while above >= 0:
            if above == handle:
                raise ValueError(f"{self.path(handle)} cannot be attached to itself or to what is attached to it")
            above = self.parent(above)  # raises for a wrong handle
        before = self.parent(handle)
        pose = self.pose(handle)
        if not in_place:
            pose = self._out_of(parent, self._into(before, pose))
        if handle >= FIRST_HANDLE:
            self.dummy(handle).parent = parent
        elif not self._is_outermost(handle):
            model = self.path(int(self._world.outermost_model_of(handle)))
            raise ValueError(f"{self.path(handle)} is a part of {model} and stays there: attach the whole model")
        elif parent < 0:
            self._edits.parents.pop(handle, None)
        else:
            self._edits.parents[handle] = parent
        if handle >= FIRST_HANDLE or not in_place:
            self.set_pose(handle, pose)

    def frame_above(self, handle: int) -> int:
        """Return the nearest object of the scene, not a dummy, that an object is attached to; -1 for the world."""
        while (handle := self.parent(handle)) >= FIRST_HANDLE:
            pass
        return handle

    def _is_outermost(self, handle: int) -> bool:
        return int(self._world.parent(handle)) < 0

    def _is_edited(self) -> bool:
        return bool(self._edits.names or self._edits.parents)

    def _attached_to(self, handle: int) -> list[int]:
        """Return the models attached to an object or to objects below it, except those that the file makes static."""
        found = []
        for model in self._edits.parents:
            above = model
            while above >= 0 and above != handle:
                above = self.parent(above)
            if above == handle and model != handle and not self._world.is_static(model):
                found.append(model)
        return found

    def _pose_changed(self, handle: int) -> None:
        """Keep the new pose of an object of the scene, where it is held or stays."""
        if handle >= FIRST_HANDLE:
            return
        self._edits.note_pose(self._world, handle)
        model = int(self._world.outermost_model_of(handle))
        if hold := self._edits.holds.get(model):
            hold.offset = relative(self._world, self._world.pose(model), hold.frame)

    def _search(self, path: str, start: int, index: int) -> int:
        """Do the same as ``find`` in a changed tree: nearer to the top first."""
        level = self.children(-1)
        found = []
        if not path.strip("./:"):
            return int(self._world.find(path, start, index)) if path != ".." else self.parent(start)
        while level:
            found += [handle for handle in level if self._matches(handle, path, start)]
            level = [child for handle in level for child in self.children(handle)]
        if index < len(found):
            return found[index]
        raise LookupError(f"no object matches '{path}'")

    def _out_of(self, frame: int, pose: Sequence[float]) -> list[float]:
        if frame < 0:
            return list(pose)
        if frame < FIRST_HANDLE:
            return list(self._frames.pose_from(pose, frame))
        return poses.multiply(self.pose(frame), pose)

    def _into(self, frame: int, pose: Sequence[float]) -> list[float]:
        if frame < FIRST_HANDLE:
            return list(pose) if frame < 0 else list(self._frames.pose_to(pose, frame))
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
