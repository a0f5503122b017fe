# SPDX-License-Identifier: BSD-3-Clause
"""`sim` functions that store and restore poses and joint positions, and let joints follow others."""

from __future__ import annotations

import math
import struct

from bubblesim.geometry import rotations
from bubblesim.scripting.api.kinds import Bytes, Handle, Vector7
from bubblesim.scripting.api.sim.joints import JointFunctions
from bubblesim.scripting.api.sim.objects import ObjectFunctions

_RECORD = struct.Struct("<q8d")  # handle, pose in the frame of the parent, position of a joint


class ConfigurationFunctions(ObjectFunctions, JointFunctions):
    """A configuration is the pose of an object in the frame of its parent, and the position of a joint."""

    def getObjectConfiguration(self, handle: Handle) -> bytes:
        """Return the configuration of an object as bytes, for setObjectConfiguration."""
        return self._configuration([self._resolve(handle)])

    def getConfigurationTree(self, handle: Handle) -> bytes:
        """Return the configurations of an object and all below it as bytes, for setConfigurationTree; those of the
        whole scene for sim.handle_all."""
        if handle == self.handle_all:
            roots = self._tree.children(self.handle_world)
            return self._configuration([each for root in roots for each in self._tree.with_all_below(root)])
        return self._configuration(self._tree.with_all_below(self._resolve(handle)))

    def setObjectConfiguration(self, configuration: Bytes) -> int:
        """Move an object to where it was, relative to its parent; return 1."""
        return self.setConfigurationTree(configuration)

    def setConfigurationTree(self, configuration: Bytes) -> int:
        """Move objects to where they were, relative to their parents, parents first; return 1. Parts that physics holds
        in a model move by its joints."""
        if len(configuration) % _RECORD.size:
            raise ValueError("the bytes are no configuration of sim.getConfigurationTree")
        for handle, *pose, position in _RECORD.iter_unpack(configuration):
            if not self._tree.contains(handle):
                continue
            if not math.isnan(position):
                self.setJointPosition(handle, position)
            elif self._is_free(handle):
                self.setObjectPose(handle, pose, self._tree.parent(handle))
        return 1

    def getJointMatrix(self, joint: Handle) -> list[float]:
        """Return the matrix of a joint's motion: from its frame at position 0 to its moving frame."""
        joint = self._resolve(joint)
        self._world.joint_type(joint)  # raises
        return rotations.matrix_of_pose(self._motion_of(joint))

    def getObjectChildPose(self, handle: Handle) -> list[float]:
        """Return the pose of what is below an object, in the object's frame: of a joint its motion."""
        return self._motion_of(self._resolve(handle))

    def setObjectChildPose(self, handle: Handle, pose: Vector7) -> None:
        """Set the position of a joint from the pose of its moving frame; of other objects without effect."""
        joint = self._resolve(handle)
        if self._tree.kind(joint) != "joint":
            return
        turn = 2 * math.atan2(pose[5], pose[6])
        self.setJointPosition(joint, pose[2] if self._world.joint_type(joint) == "prismatic" else turn)

    def getJointDependency(self, joint: Handle) -> tuple[int, float, float]:
        """Return the joint that this one follows (-1: none), the offset and the factor, as setJointDependency set
        them."""
        joint = self._resolve(joint)
        self._world.joint_type(joint)  # raises
        settings = self._caller.shared.settings
        other, offset, factor = settings.get((tuple, f"dependency of {joint}"), (-1, 0.0, 1.0))
        return int(other), float(offset), float(factor)

    def setJointDependency(self, joint: Handle, other: int, offset: float = 0.0, factor: float = 1.0) -> None:
        """Let a joint follow another one, in each step: its position is offset + factor * that of the other one. -1
        ends it."""
        joint = self._resolve(joint)
        self._world.joint_type(joint)  # raises
        key = ("dependency", joint)
        if other < 0:
            self._caller.in_each_step.pop(key, None)
            self._caller.shared.settings.pop((tuple, f"dependency of {joint}"), None)
            return
        leader = self._resolve(other)
        self._world.joint_type(leader)  # raises
        self._caller.shared.settings[tuple, f"dependency of {joint}"] = (leader, offset, factor)

        def follow() -> None:
            if self._tree.contains(joint) and self._tree.contains(leader):
                self.setJointPosition(joint, offset + factor * self.getJointPosition(leader))

        follow()
        self._caller.in_each_step[key] = follow

    def getObjectHierarchyOrder(self, handle: Handle) -> int:
        """Return the place of an object among its siblings, from 0."""
        handle = self._resolve(handle)
        return self._tree.children(self._tree.parent(handle)).index(handle)

    def setObjectHierarchyOrder(self, handle: Handle, order: int) -> None:
        """Accept the place of an object among its siblings, which stays that of the file or of its creation."""
        self._tree.kind(self._resolve(handle))  # raises

    def _configuration(self, handles: list[int]) -> bytes:
        records = []
        for handle in handles:
            is_joint = self._tree.kind(handle) == "joint" and self._world.joint_type(handle) not in ("fixed", "ball")
            position = float(self._world.joint_position(handle)) if is_joint else math.nan
            pose = self._tree.pose_in(handle, self._tree.parent(handle))
            records.append(_RECORD.pack(handle, *pose, position))
        return b"".join(records)

    def _is_free(self, handle: int) -> bool:
        """Return whether setObjectPose moves an object as a whole."""
        if not self._tree.has_body(handle):
            return self._tree.kind(handle) != "joint"
        model = self._tree.model(handle)
        return self._tree.object_of(model) == handle and not self._world.is_static(model)
