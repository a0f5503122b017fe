# SPDX-License-Identifier: BSD-3-Clause
"""What scripts and programs change in the scene's own objects: names, parents, poses, and which models stand still."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from typing import Any

from bubblesim.scene_state.created_sensors import CreatedSensor
from bubblesim.scene_state.created_shapes import CreatedShape
from bubblesim.scene_state.set_colours import SetColours
from bubblesim.scene_state.set_numbers import SetNumbers


@dataclass
class Hold:
    """A model that keeps its pose in the frame of another object."""

    frame: int
    """Handle of an object of the scene; -1 for the world."""
    offset: list[float]
    """Pose in that frame."""


@dataclass
class SceneEdits:
    """The changes, by handle of the object. Those of a run end with it; those of the stopped scene stay."""

    names: dict[int, str] = field(default_factory=dict)
    """New names of objects, and"""
    parents: dict[int, int] = field(default_factory=dict)
    """new parents, which the world has too: kept to take them back, and because files have no place for them."""
    static: set[int] = field(default_factory=set)
    """Models that move only with their parent."""
    holds: dict[int, Hold] = field(default_factory=dict)
    placed: dict[int, list[float]] = field(default_factory=dict)
    """Poses in the world that were set while the simulation was stopped, in the order of their setting."""
    shapes: dict[int, CreatedShape] = field(default_factory=dict)
    """Created shapes, by the handle of their model."""
    sensors: dict[int, int] = field(default_factory=dict)
    """Created sensors, by the handle of their link, which is the object that callers know."""
    created_sensors: dict[int, CreatedSensor] = field(default_factory=dict)
    """Their descriptions, likewise."""
    sources: dict[int, str] = field(default_factory=dict)
    """SDFormat strings of models that callers have added."""
    foreign: dict[int, list[int]] = field(default_factory=dict)
    """What callers have added from files of CoppeliaSim: its models, by the object at the top."""
    originals: dict[int, str] = field(default_factory=dict)
    """Names of the file's models of which others are copies."""
    colours: SetColours = field(default_factory=SetColours)
    numbers: SetNumbers = field(default_factory=SetNumbers)
    held_joints: dict[int, tuple[Any, float]] = field(default_factory=dict)
    """Joints in kinematic mode, with the motor mode and largest force that they had; for a run."""
    callback_joints: dict[int, bool] = field(default_factory=dict)
    """Joints that a script has given to the callback sysCall_joint, or taken from it; for a run."""
    replaced: dict[int, int] = field(default_factory=dict)
    """Present handles of created shapes and sensors that were built anew, by the handle that callers know."""
    stopped: Callable[[], bool] = lambda: False
    """Whether the simulation is stopped: changes stay then."""
    moved: set[int] = field(default_factory=set)
    """All objects of the scene that ever got another name or parent."""
    tree_changed: Callable[[], None] = lambda: None
    """Called after a change of a name or a parent."""
    _first_names: dict[int, str] = field(default_factory=dict)
    """Of the file."""
    _first_parents: dict[int, int] = field(default_factory=dict)
    _before: tuple[dict[int, str], dict[int, int], set[int], dict[int, Hold]] | None = None

    def begin_change(self) -> None:
        """Keep what the end of the run brings back; call it before a change."""
        if not self.stopped() and self._before is None:
            self._before = (dict(self.names), dict(self.parents), set(self.static), dict(self.holds))

    def note_name(self, handle: int, before: str, name: str) -> None:
        """Keep the new name of an object of the scene."""
        first = self._first_names.setdefault(handle, before)
        self.moved.add(handle)
        self.names[handle] = name
        if name == first:
            del self.names[handle], self._first_names[handle]

    def note_parent(self, handle: int, before: int, parent: int) -> None:
        """Keep the new parent of an object of the scene."""
        first = self._first_parents.setdefault(handle, before)
        self.moved.add(handle)
        self.parents[handle] = parent
        if parent == first:
            del self.parents[handle], self._first_parents[handle]

    def end_run(self, world: Any) -> None:
        """Take back the changes of the run that has ended."""
        self.held_joints.clear()
        self.callback_joints.clear()
        if self._before is None:
            return
        names, parents, self.static, self.holds = self._before
        for handle in self.names:
            world.set_alias(handle, names.get(handle, self._first_names[handle]))
        for handle in self.parents:
            wanted = parents.get(handle, self._first_parents[handle])
            if int(world.parent(handle)) != wanted:
                world.set_parent(handle, wanted)
        self.names, self.parents = names, parents
        self._first_names = {handle: name for handle, name in self._first_names.items() if handle in names}
        self._first_parents = {handle: each for handle, each in self._first_parents.items() if handle in parents}
        self._before = None
        self.tree_changed()

    def remove(self, gone: set[int]) -> None:
        """Forget objects that are about to be removed; models that are attached to them belong to the world then."""
        for handle in gone:
            tables: list[dict[int, Any]] = [
                self.names,
                self.parents,
                self.holds,
                self.placed,
                self.shapes,
                self.sensors,
                self.created_sensors,
                self.sources,
                self.foreign,
            ]
            tables += [self.originals, self.colours.links, self.numbers.links]
            tables += [self._first_names, self._first_parents]
            for table in tables:
                table.pop(handle, None)
            self.static.discard(handle)
            self.callback_joints.pop(handle, None)
            self.moved.discard(handle)
        for attached in [handle for handle, parent in self.parents.items() if parent in gone]:
            del self.parents[attached], self._first_parents[attached]
        for table in self._before[:2] if self._before else ():
            for handle in [handle for handle in table if handle in gone or table[handle] in gone]:
                del table[handle]
        for hold in self.holds.values():
            if hold.frame in gone:
                hold.frame = -1
        for known in [known for known, handle in self.replaced.items() if handle in gone]:
            del self.replaced[known]

    def known_handle(self, handle: int) -> int:
        """Return the handle under which callers know an object."""
        for known, present in self.replaced.items():
            if present == handle:
                return known
        return handle

    # Poses

    def note_pose(self, world: Any, handle: int) -> None:
        """Keep the pose of an object if it was set while the simulation was stopped; call it afterwards."""
        if self.stopped():
            self.placed.pop(handle, None)
            self.placed[handle] = list(world.pose(handle))

    def restore(self, world: Any) -> None:
        """Set the poses and numbers of the stopped scene again, after the world was reset."""
        self.numbers.restore(world)
        for handle, parent in self.parents.items():
            world.set_parent(handle, parent)  # a frame is carried by it again
        for handle, pose in self.placed.items():
            world.set_pose(handle, pose)
        for model, hold in self.holds.items():
            hold.offset = relative(world, world.pose(model), hold.frame)

    def apply(self, world: Any, ahead: float = 0.0) -> None:
        """Put the held models where they belong; call it before and after the physics of a step.

        :param ahead: s of physics that follow. Half of the speed that gravity adds is taken away before, so that a
            model ends where it begins; a created shape that is static has no weight.
        """
        for model, hold in self.holds.items():
            linear, angular = [0.0, 0.0, 0.0], [0.0, 0.0, 0.0]
            pose = hold.offset
            if hold.frame >= 0:
                pose = world.pose_from(hold.offset, hold.frame)
                linear, angular = (list(part) for part in world.velocity(hold.frame))
                arm = [a - b for a, b in zip(pose[:3], world.pose(hold.frame)[:3], strict=True)]
                linear = [v + w for v, w in zip(linear, _cross(angular, arm), strict=True)]
            if model not in self.shapes:
                linear = [v - g * ahead / 2 for v, g in zip(linear, world.gravity, strict=True)]
            world.set_state(model, pose, linear, angular)


def _cross(a: Sequence[float], b: Sequence[float]) -> list[float]:
    return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]


def relative(world: Any, pose: Sequence[float], frame: int) -> list[float]:
    """Return a pose in the world as one in the frame of an object; -1 is the world."""
    return list(pose) if frame < 0 else list(world.pose_to(pose, frame))
