# SPDX-License-Identifier: BSD-3-Clause
"""Environments of simIK: trees of dummies and joints, with groups of elements that a solver fulfils."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass, field

from bubblesim.geometry import poses

REVOLUTE, PRISMATIC, SPHERICAL = 10, 11, 12
PASSIVE, IK = 0, 2  # modes of joints
X, Y, Z, ALPHA_BETA, GAMMA = 1, 2, 4, 8, 16
ALL = X | Y | Z | ALPHA_BETA | GAMMA
WORLD = -1
_MOST = 100_000


@dataclass
class IkObject:
    """A dummy or joint."""

    handle: int
    name: str
    is_joint: bool
    parent: int = WORLD
    pose: list[float] = field(default_factory=lambda: list(poses.IDENTITY))
    """In the frame of the parent; of a joint for its position 0."""
    joint_type: int = REVOLUTE
    position: float = 0.0
    """rad or m."""
    mode: int = IK
    cyclic: bool = True
    low: float = -math.pi
    high: float = math.pi
    weight: float = 1.0
    max_step: float = math.radians(10.0)
    """Of one iteration, rad or m."""
    dependency: tuple[int, float, float] | None = None
    """Handle of another joint, offset and factor: the position is offset + factor * that of the other one."""
    target: int = -1
    """The dummy that this one is to reach."""


@dataclass
class Element:
    """A tip that is to reach its target."""

    tip: int
    base: int
    constraint_base: int = WORLD
    """In whose axes the position is constrained; WORLD: those of the world."""
    constraints: int = ALL
    precision: list[float] = field(default_factory=lambda: [0.0005, math.radians(0.1)])
    """m and rad."""
    weights: list[float] = field(default_factory=lambda: [1.0, 1.0])
    is_enabled: bool = True


@dataclass
class Group:
    """Elements that are solved together."""

    handle: int
    name: str
    method: int = 0
    damping: float = 0.1
    iterations: int = 3
    flags: int = 1
    elements: list[Element] = field(default_factory=list)


class Environment:
    """Objects and groups by handle."""

    def __init__(self) -> None:
        """Create it empty."""
        self.objects: dict[int, IkObject] = {}
        self.groups: dict[int, Group] = {}
        self.structure = 0
        """Rises when chains of joints change."""
        self.scene_objects: dict[int, int] = {}
        """Objects by the handle of the scene's object that they are a copy of."""
        self._created = 0

    def add(self, name: str, *, is_joint: bool, joint_type: int = REVOLUTE) -> IkObject:
        """Add an object at the origin."""
        if len(self.objects) >= _MOST:
            raise ValueError(f"an environment has at most {_MOST} objects")
        made = IkObject(self._next(), name, is_joint, joint_type=joint_type)
        if joint_type == PRISMATIC:
            made.low, made.high, made.cyclic, made.max_step = -1e9, 1e9, False, 0.1
        self.objects[made.handle] = made
        self.structure += 1
        return made

    def add_group(self, name: str) -> Group:
        """Add a group without elements."""
        group = Group(self._next(), name)
        self.groups[group.handle] = group
        return group

    def at(self, handle: int) -> IkObject:
        """Return an object; raise LookupError if there is none."""
        if handle not in self.objects:
            raise LookupError(f"the environment has no object {handle}")
        return self.objects[handle]

    def joint(self, handle: int) -> IkObject:
        """Return a joint; raise ValueError for another object."""
        found = self.at(handle)
        if not found.is_joint:
            raise ValueError(f"the object {found.name} is a dummy, not a joint")
        return found

    def group(self, handle: int) -> Group:
        """Return a group; raise LookupError if there is none."""
        if handle not in self.groups:
            raise LookupError(f"the environment has no group {handle}")
        return self.groups[handle]

    def moved(self, joint: IkObject) -> list[float]:
        """Return the pose of a joint's moving frame in the frame of its parent."""
        if joint.joint_type == PRISMATIC:
            motion = [0.0, 0.0, joint.position, 0.0, 0.0, 0.0, 1.0]
        else:
            motion = [0.0, 0.0, 0.0, 0.0, 0.0, math.sin(joint.position / 2), math.cos(joint.position / 2)]
        return poses.multiply(joint.pose, motion)

    def pose(self, handle: int, *, moved: bool = False) -> list[float]:
        """Return the pose of an object in the world; of a joint that of its base, or its moving frame."""
        if handle == WORLD:
            return list(poses.IDENTITY)
        found = self.at(handle)
        own = self.moved(found) if found.is_joint and moved else found.pose
        return poses.multiply(self.pose(found.parent, moved=True), own)

    def set_pose(self, handle: int, pose: list[float]) -> None:
        """Set the pose of an object in the world."""
        found = self.at(handle)
        found.pose = poses.multiply(poses.inverse(self.pose(found.parent, moved=True)), pose)
        self.structure += 1

    def set_parent(self, handle: int, parent: int, *, in_place: bool) -> None:
        """Attach an object to another one."""
        found = self.at(handle)
        if parent != WORLD and handle in (each.handle for each in self.above(parent, with_itself=True)):
            raise ValueError("an object cannot be below itself")
        pose = self.pose(handle)
        found.parent = parent
        self.structure += 1
        if in_place:
            self.set_pose(handle, pose)

    def above(self, handle: int, *, with_itself: bool = False) -> Iterator[IkObject]:
        """Yield the objects above one, the nearest first."""
        each = self.at(handle)
        if with_itself:
            yield each
        while each.parent != WORLD:
            each = self.at(each.parent)
            yield each

    def erase(self, handle: int) -> None:
        """Remove an object; those below it belong to the world then."""
        for each in [each for each in self.objects.values() if each.parent == handle]:
            self.set_parent(each.handle, WORLD, in_place=True)
        self.at(handle)
        del self.objects[handle]
        self.scene_objects = {scene: own for scene, own in self.scene_objects.items() if own != handle}
        self.structure += 1

    def follow_dependencies(self) -> None:
        """Set the positions of joints that depend on others."""
        for each in self.objects.values():
            if each.dependency is not None and each.dependency[0] in self.objects:
                other, offset, factor = each.dependency
                each.position = offset + factor * self.objects[other].position

    def _next(self) -> int:
        self._created += 1
        return self._created
