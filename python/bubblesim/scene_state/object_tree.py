# SPDX-License-Identifier: BSD-3-Clause
"""The tree of objects as scripts see it, with the poses in its axes."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from bubblesim._core import ObjectFrames, WrongObject
from bubblesim.scene_state.dummies import Dummies, Dummy
from bubblesim.scene_state.scene_edits import SceneEdits, relative

WORLD = -1


def is_script_object(world: Any, handle: int) -> bool:
    """Return whether an object is nothing but a script, which acts for its parent."""
    return str(world.kind(handle)) == "frame" and str(world.frame_kind(handle)) == "script"


def acting_object(world: Any, handle: int) -> int:
    """Return the object for which a script acts whose own object is `handle`."""
    return int(world.parent(handle)) if is_script_object(world, handle) else handle


class ObjectTree:
    """The tree of a world. Changes of the scene's own objects are kept in ``edits``; -1 is the world."""

    def __init__(self, world: Any, dummies: Dummies, edits: SceneEdits) -> None:
        """Show the tree of a world."""
        self._world = world
        self._frames = ObjectFrames(world)
        self._dummies = dummies
        self._edits = edits

    def dummy(self, handle: int) -> Dummy:
        """Return the size and colours of an object without a body; raise ValueError if it has one."""
        if self._world.kind(handle) != "frame":
            raise ValueError(f"{self.path(handle)} is not a dummy")
        return self._dummies.of(handle)

    def is_created_dummy(self, handle: int) -> bool:
        """Return whether a script or program created this object as a dummy."""
        return handle in self._dummies.by_handle

    def contains(self, handle: int) -> bool:
        """Return whether this is the handle of an object."""
        return bool(self._world.contains(handle))

    def kind(self, handle: int) -> str:
        """Return 'model', 'link', 'joint' or 'sensor'; of an object without a body 'dummy', 'shape', 'camera' ..."""
        kind = str(self._world.kind(handle))
        return str(self._world.frame_kind(handle)) if kind == "frame" else kind

    def has_body(self, handle: int) -> bool:
        """Return whether it is a part of a model that physics knows: a model, link, joint or sensor."""
        return str(self._world.kind(handle)) != "frame"

    def is_kinematic(self, handle: int) -> bool:
        """Return whether physics does not hold an object: a joint that moves only when it is set, a static link."""
        if self.kind(handle) == "link":
            return bool(self._world.is_static(handle))
        return bool(self._world.is_kinematic(handle))

    def name(self, handle: int) -> str:
        """Return the name without an index."""
        return str(self._world.alias(handle))

    def parent(self, handle: int) -> int:
        """Return the parent, -1 at the top."""
        return int(self._world.parent(handle))

    def children(self, handle: int) -> list[int]:
        """Return the children; those of -1 are the objects at the top."""
        return [int(child) for child in self._world.children(handle)]

    def with_all_below(self, handle: int) -> list[int]:
        """Return an object and all its descendants, parents first."""
        return [int(each) for each in self._world.subtree(handle)]

    def path(self, handle: int) -> str:
        """Return the full path."""
        return str(self._world.path(handle))

    def short_path(self, handle: int) -> str:
        """Return the shortest path that is unique in the scene."""
        return str(self._world.short_path(handle))

    def find(self, path: str, start: int, index: int = 0) -> int:
        """Return the object at a path, see ``World.find``; raise LookupError if there is none."""
        return int(self._world.find(path, start, index))

    def pose(self, handle: int) -> list[float]:
        """Return the pose in the world."""
        return list(self._frames.pose(handle))

    def pose_in(self, handle: int, frame: int) -> list[float]:
        """Return the pose in the frame of another object; of a joint in its moving frame."""
        return self.pose(handle) if frame < 0 else list(self._frames.pose_in(handle, frame))

    def set_pose(self, handle: int, pose: Sequence[float], frame: int = WORLD) -> None:
        """Set the pose in the world (-1) or in the frame of another object; what is below it moves along."""
        if frame < 0:
            self._frames.set_pose(handle, pose)
        else:
            self._frames.set_pose_in(handle, pose, frame)
        self.note_poses(handle)

    def set_parent(self, handle: int, parent: int, *, in_place: bool) -> None:
        """Attach an object to another one or to the world (-1); raise ValueError if physics holds it elsewhere."""
        self._check_free(handle)
        before = self.parent(handle)
        in_parent = self.pose_in(handle, before)
        self._world.set_parent(handle, parent)  # raises ValueError for an object below it
        if not self.is_created_dummy(handle):
            self._edits.note_parent(handle, before, parent)
        self._edits.tree_changed()
        if not in_place:
            self.set_pose(handle, in_parent, parent)
        elif not self.has_body(handle):
            self.note_poses(handle)

    def set_name(self, handle: int, name: str) -> None:
        """Name an object."""
        if not self.is_created_dummy(handle):
            self._edits.note_name(handle, self.name(handle), name)
        self._world.set_alias(handle, name)
        self._edits.tree_changed()

    def model(self, handle: int) -> int:
        """Return the handle under which physics knows what moves together with an object; -1 if there is nothing."""
        return int(self._world.outermost_model_of(handle))

    def object_of(self, model: int) -> int:
        """Return the object that scripts see as a model: its handle, or that of its first link."""
        links = self._world.parts(model, "link") if self._world.is_hidden(model) else [model]
        return int(links[0])

    def frame_above(self, handle: int) -> int:
        """Return the nearest object of a model that an object is attached to; -1 for the world."""
        while (handle := self.parent(handle)) >= 0 and not self.has_body(handle):
            pass
        return handle

    def _check_free(self, handle: int) -> None:
        """Raise ValueError for a part of a model, which stays where physics holds it."""
        if self.kind(handle) not in ("model", "link", "joint", "sensor", "shape") or self.is_kinematic(handle):
            return
        model = self.model(handle)
        is_first = self.kind(handle) in ("model", "link") and self.model_above(handle) != model
        if model >= 0 and not is_first:
            path = self.short_path(self._world.model_base_of(handle))
            raise WrongObject(f"{self.path(handle)} is a part of {path} and stays there: attach the whole model")

    def note_poses(self, handle: int) -> None:
        """Keep the new poses of an object of the scene, and of what moved along, where they are held or stay."""
        edits = self._edits
        if not edits.holds and not edits.stopped():
            return
        for each in self.with_all_below(handle):
            kind = str(self._world.kind(each))
            model = self.model(each) if kind in ("model", "link") else -1
            # The model of a link that is its first object.
            is_whole = model >= 0 and (each == model or self.model_above(each) != model)
            if not self.is_created_dummy(each) and (each == handle or each in edits.placed or is_whole):
                edits.note_pose(self._world, each)
            if hold := edits.holds.get(model):
                hold.offset = relative(self._world, self._world.pose(model), hold.frame)

    def model_above(self, handle: int) -> int:
        """Return the model of the parent, -1 if there is none."""
        above = self.parent(handle)
        return -1 if above < 0 else self.model(above)
