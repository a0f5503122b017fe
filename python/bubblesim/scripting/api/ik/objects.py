# SPDX-License-Identifier: BSD-3-Clause
"""`simIK` functions for environments and their objects."""

from __future__ import annotations

import copy
import math
from typing import Any

from bubblesim.geometry import poses, rotations
from bubblesim.scripting.api.ik.context import IkContext
from bubblesim.scripting.api.ik.environment import PRISMATIC, REVOLUTE, SPHERICAL, WORLD, Environment
from bubblesim.scripting.api.kinds import Numbers, Vector3, Vector4, Vector7, Vector12

_PARENT = -11
_ALL_TURNS = [-math.pi, math.tau]


class IkObjectFunctions(IkContext):
    """Objects have handles of their own in each environment. Positions of joints in rad or m."""

    def createEnvironment(self, flags: int = 0) -> int:
        """Create an empty environment and return its handle."""
        return self._add_environment(Environment())

    def eraseEnvironment(self, environment: int) -> None:
        """Remove an environment."""
        self._environment(environment)
        del self._environments[environment]

    def duplicateEnvironment(self, environment: int) -> int:
        """Return a copy of an environment."""
        return self._add_environment(copy.deepcopy(self._environment(environment)))

    def createJoint(self, environment: int, kind: int, name: str = "") -> int:
        """Create a joint, simIK.jointtype_revolute or jointtype_prismatic, and return its handle."""
        if kind not in (REVOLUTE, PRISMATIC, SPHERICAL):
            raise ValueError(f"{kind} is not a type of joint: use simIK.jointtype_revolute, prismatic or spherical")
        return self._environment(environment).add(name, is_joint=True, joint_type=kind).handle

    def createDummy(self, environment: int, name: str = "") -> int:
        """Create a dummy and return its handle."""
        return self._environment(environment).add(name, is_joint=False).handle

    def eraseObject(self, environment: int, handle: int) -> None:
        """Remove an object."""
        self._environment(environment).erase(handle)

    def doesObjectExist(self, environment: int, name: str) -> bool:
        """Return whether there is an object with a name."""
        return any(each.name == name for each in self._environment(environment).objects.values())

    def getObjectHandle(self, environment: int, name: str) -> int:
        """Return the handle of the object with a name."""
        for each in self._environment(environment).objects.values():
            if each.name == name:
                return each.handle
        raise LookupError(f"the environment has no object '{name}'")

    def getObjects(self, environment: int, index: int) -> tuple[int, str, bool, int]:
        """Return handle, name, whether it is a joint, and the type of the object with an index from 0; -1 if there are
        fewer."""
        objects = list(self._environment(environment).objects.values())
        if not 0 <= index < len(objects):
            return -1, "", False, 0
        found = objects[index]
        return found.handle, found.name, found.is_joint, found.joint_type if found.is_joint else 0

    def getObjectType(self, environment: int, handle: int) -> int:
        """Return simIK.objecttype_joint or objecttype_dummy."""
        return 1 if self._environment(environment).at(handle).is_joint else 4

    def getObjectParent(self, environment: int, handle: int) -> int:
        """Return the parent of an object, -1 at the top."""
        return self._environment(environment).at(handle).parent

    def setObjectParent(self, environment: int, handle: int, parent: int, keep_in_place: bool = True) -> None:
        """Attach an object to another one, or to the world (-1)."""
        self._environment(environment).set_parent(handle, parent, in_place=keep_in_place)

    def getObjectPose(self, environment: int, handle: int, relative_to: int = WORLD) -> list[float]:
        """Return the pose of an object in the world or in the frame of another one (a joint: its moving frame)."""
        found = self._environment(environment)
        frame = self._frame(found, handle, relative_to)
        return poses.multiply(poses.inverse(found.pose(frame, moved=True)), found.pose(handle))

    def setObjectPose(self, environment: int, handle: int, first: Any, second: Any = WORLD) -> None:
        """Set the pose of an object, in the world or in the frame of another one: (pose, frame), or in the order of
        older scripts (frame, pose)."""
        pose, relative_to = _pose_first(first, second)
        if len(pose) != 7:
            raise ValueError(f"a pose has 7 numbers, found {len(pose)}")
        self._set_pose(environment, handle, pose, relative_to)

    def getObjectMatrix(self, environment: int, handle: int, relative_to: int = WORLD) -> list[float]:
        """Return the pose of an object as a matrix of 12 numbers."""
        return rotations.matrix_of_pose(self.getObjectPose(environment, handle, relative_to))

    def setObjectMatrix(self, environment: int, handle: int, first: Any, second: Any = WORLD) -> None:
        """Set the pose of an object by a matrix of 12 numbers; both orders, see setObjectPose."""
        matrix, relative_to = _pose_first(first, second)
        if len(matrix) not in (12, 16):
            raise ValueError(f"a matrix has 12 numbers, found {len(matrix)}")
        self._set_pose(environment, handle, poses.of_matrix(matrix[:12]), relative_to)

    def getObjectTransformation(
        self, environment: int, handle: int, relative_to: int = WORLD
    ) -> tuple[list[float], list[float], list[float]]:
        """Return position, quaternion and Euler angles of an object."""
        pose = self.getObjectPose(environment, handle, relative_to)
        return pose[:3], pose[3:], rotations.euler_angles(pose[3:])

    def setObjectTransformation(
        self, environment: int, handle: int, relative_to: int, position: Vector3, rotation: Numbers
    ) -> None:
        """Set position and quaternion (4 numbers) or Euler angles (3 numbers) of an object."""
        quaternion = list(rotation) if len(rotation) == 4 else rotations.quaternion_of_euler(rotation)
        self._set_pose(environment, handle, [*position, *quaternion], relative_to)

    def getJointType(self, environment: int, joint: int) -> int:
        """Return simIK.jointtype_revolute, prismatic or spherical."""
        return self._joint(environment, joint).joint_type

    def getJointPosition(self, environment: int, joint: int) -> float:
        """Return the position of a joint."""
        return self._joint(environment, joint).position

    def setJointPosition(self, environment: int, joint: int, position: float) -> None:
        """Set the position of a joint."""
        found = self._environment(environment)
        found.joint(joint).position = position
        found.follow_dependencies()

    def getJointMode(self, environment: int, joint: int) -> int:
        """Return simIK.jointmode_ik or jointmode_passive."""
        return self._joint(environment, joint).mode

    def setJointMode(self, environment: int, joint: int, mode: int) -> None:
        """Set simIK.jointmode_ik, or jointmode_passive: then the joint does not move."""
        self._joint(environment, joint).mode = mode
        self._environment(environment).structure += 1

    def getJointInterval(self, environment: int, joint: int) -> tuple[bool, list[float]]:
        """Return whether a joint has no limits, and [lower limit, range]."""
        found = self._joint(environment, joint)
        return found.cyclic, [found.low, found.high - found.low]

    def setJointInterval(self, environment: int, joint: int, cyclic: bool, interval: Numbers = _ALL_TURNS) -> None:
        """Set whether a joint has no limits, and [lower limit, range]."""
        found = self._joint(environment, joint)
        found.cyclic = cyclic
        if len(interval) >= 2:
            found.low, found.high = interval[0], interval[0] + interval[1]

    def getJointWeight(self, environment: int, joint: int) -> float:
        """Return by how much a joint takes part, 0 to 1."""
        return self._joint(environment, joint).weight

    def setJointWeight(self, environment: int, joint: int, weight: float) -> None:
        """Set by how much a joint takes part, 0 to 1."""
        if not 0 <= weight <= 1:
            raise ValueError(f"the weight of a joint is from 0 to 1, found {weight:g}")
        self._joint(environment, joint).weight = weight

    def getJointMaxStepSize(self, environment: int, joint: int) -> float:
        """Return by how much a joint moves in one iteration at most."""
        return self._joint(environment, joint).max_step

    def setJointMaxStepSize(self, environment: int, joint: int, size: float) -> None:
        """Set by how much a joint moves in one iteration at most."""
        if not size > 0:
            raise ValueError(f"the greatest step of a joint must be positive, found {size:g}")
        self._joint(environment, joint).max_step = size

    def getJointDependency(self, environment: int, joint: int) -> tuple[int, float, float]:
        """Return the joint on which a joint depends (-1: none), offset and factor."""
        return self._joint(environment, joint).dependency or (-1, 0.0, 1.0)

    def setJointDependency(
        self, environment: int, joint: int, other: int, offset: float = 0.0, factor: float = 1.0
    ) -> None:
        """Let the position of a joint be offset + factor times that of another one; -1: let it be free."""
        found = self._environment(environment)
        found.joint(joint).dependency = (found.joint(other).handle, offset, factor) if other >= 0 else None
        found.structure += 1
        found.follow_dependencies()

    def getJointMatrix(self, environment: int, joint: int) -> list[float]:
        """Return the motion of a joint as a matrix of 12 numbers."""
        found = self._environment(environment)
        each = found.joint(joint)
        return rotations.matrix_of_pose(poses.multiply(poses.inverse(each.pose), found.moved(each)))

    def getJointTransformation(self, environment: int, joint: int) -> tuple[list[float], list[float], list[float]]:
        """Return the motion of a joint: position, quaternion and Euler angles."""
        pose = poses.of_matrix(self.getJointMatrix(environment, joint))
        return pose[:3], pose[3:], rotations.euler_angles(pose[3:])

    def setSphericalJointMatrix(self, environment: int, joint: int, matrix: Vector12) -> None:
        """Turn a spherical joint: it is rigid otherwise."""
        self._turn(environment, joint, poses.of_matrix(matrix)[3:])

    def setSphericalJointRotation(self, environment: int, joint: int, quaternion: Vector4) -> None:
        """Turn a spherical joint: it is rigid otherwise."""
        self._turn(environment, joint, quaternion)

    def getTargetDummy(self, environment: int, dummy: int) -> int:
        """Return the dummy that a dummy is to reach, -1 if there is none."""
        return self._environment(environment).at(dummy).target

    def setTargetDummy(self, environment: int, dummy: int, target: int) -> None:
        """Set the dummy that a dummy is to reach; -1: none."""
        found = self._environment(environment)
        if target >= 0:
            found.at(target)  # raises
        found.at(dummy).target = target

    def _turn(self, environment: int, joint: int, quaternion: list[float]) -> None:
        found = self._environment(environment)
        each = found.joint(joint)
        each.pose = [*each.pose[:3], *quaternion]
        found.structure += 1

    def _frame(self, environment: Environment, handle: int, relative_to: int) -> int:
        return environment.at(handle).parent if relative_to == _PARENT else relative_to

    def _set_pose(self, environment: int, handle: int, pose: Vector7, relative_to: int) -> None:
        found = self._environment(environment)
        frame = found.pose(self._frame(found, handle, relative_to), moved=True)
        found.set_pose(handle, poses.multiply(frame, pose))


def _pose_first(first: object, second: object) -> tuple[list[float], int]:
    """Return numbers and frame of two arguments in one of both orders."""
    if isinstance(first, int):
        first, second = second, first
    if isinstance(first, str) or not hasattr(first, "__iter__") or not isinstance(second, int):
        raise TypeError("expected a list of numbers and the handle of a frame")
    return [float(number) for number in first], second
