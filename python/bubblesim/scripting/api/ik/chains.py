# SPDX-License-Identifier: BSD-3-Clause
"""Chains of joints between a base and a tip: pose and Jacobian of the tip, by Orocos KDL."""

from __future__ import annotations

from typing import Any

import numpy as np
import numpy.typing as npt

from bubblesim.geometry import poses
from bubblesim.scripting.api.ik.environment import IK, PRISMATIC, WORLD, Environment, IkObject

Array = npt.NDArray[np.float64]
_PRECISION = 1e-7  # m, and a tenth of it for rad
_SEARCH_ITERATIONS = 40


def load_kdl() -> Any:
    """Return the module PyKDL; raise RuntimeError if it is not installed."""
    try:
        import PyKDL
    except ImportError as error:
        raise RuntimeError(f"simIK needs Debian's package python3-pykdl ({error}): run scripts/setup") from None
    return PyKDL


class Chain:
    """The joints from a base to a tip, which move it; those that are passive count as rigid."""

    def __init__(self, environment: Environment, base: int, tip: int) -> None:
        """Prepare the chain; the base must be the world or above the tip."""
        kdl = load_kdl()
        way: list[IkObject] = []
        for each in environment.above(tip, with_itself=True):
            if each.handle == base:
                break
            way.append(each)
        else:
            if base != WORLD:
                raise ValueError(
                    f"the base {environment.at(base).name} is not above the tip {environment.at(tip).name}"
                )
        self.joints: list[IkObject] = []
        self._rigid: list[tuple[IkObject, float]] = []  # passive joints, and where they were
        chain = kdl.Chain()
        fixed = list(poses.IDENTITY)
        for each in reversed(way):
            if each.is_joint and each.mode == IK and each.dependency is None and each.joint_type != 12:
                chain.addSegment(kdl.Segment(kdl.Joint(kdl.Joint.Fixed), _frame(kdl, poses.multiply(fixed, each.pose))))
                kind = kdl.Joint.TransZ if each.joint_type == PRISMATIC else kdl.Joint.RotZ
                chain.addSegment(kdl.Segment(kdl.Joint(kind), kdl.Frame()))
                self.joints.append(each)
                fixed = list(poses.IDENTITY)
            elif each.is_joint:
                self._rigid.append((each, each.position))
                fixed = poses.multiply(fixed, environment.moved(each))
            else:
                fixed = poses.multiply(fixed, each.pose)
        chain.addSegment(kdl.Segment(kdl.Joint(kdl.Joint.Fixed), _frame(kdl, fixed)))
        count = len(self.joints)
        self._chain = chain  # the solvers refer to it
        self._angles = kdl.JntArray(max(1, count)) if count else kdl.JntArray(0)
        self._pose = kdl.Frame()
        self._columns = kdl.Jacobian(count) if count else None
        self._forward = kdl.ChainFkSolverPos_recursive(chain)
        self._derivative = kdl.ChainJntToJacSolver(chain)
        self._kdl = kdl
        self._searches: dict[bool, Any] = {}  # Levenberg and Marquardt's, by whether the orientation counts

    @property
    def has_dependent_joints(self) -> bool:
        """Return whether joints of it follow others."""
        return any(joint.dependency is not None for joint, _ in self._rigid)

    def find(self, goal: list[float], *, with_orientation: bool) -> list[float] | None:
        """Return positions of the joints, from where they are, with which the tip reaches a pose in the frame of the
        base; None if the search of KDL finds none. Limits are not considered."""
        search = self._searches.get(with_orientation)
        if search is None:
            weights = np.array([1.0, 1.0, 1.0, *([0.1] * 3 if with_orientation else [0.0] * 3)])
            search = self._kdl.ChainIkSolverPos_LMA(self._chain, weights, _PRECISION, _SEARCH_ITERATIONS, 1e-15)
            self._searches[with_orientation] = search
        for number, joint in enumerate(self.joints):
            self._angles[number] = joint.position
        found = self._kdl.JntArray(len(self.joints))
        if search.CartToJnt(self._angles, _frame(self._kdl, goal), found) < 0:
            return None
        return [float(found[number]) for number in range(len(self.joints))]

    def is_current(self) -> bool:
        """Return whether no passive joint has moved since."""
        return all(joint.position == position for joint, position in self._rigid)

    def evaluate(self) -> tuple[Array, Array, Array]:
        """Return position and rotation matrix of the tip in the frame of the base, and the Jacobian, 6 x joints: linear
        velocity of the tip and angular velocity, in the axes of the base, for the present positions of the joints."""
        for number, joint in enumerate(self.joints):
            self._angles[number] = joint.position
        self._forward.JntToCart(self._angles, self._pose)
        place, turn = self._pose.p, self._pose.M
        position = np.array([place[0], place[1], place[2]])
        rotation = np.array([[turn[i, j] for j in range(3)] for i in range(3)])
        if self._columns is None:
            return position, rotation, np.zeros((6, 0))
        self._derivative.JntToJac(self._angles, self._columns)
        columns, count = self._columns, range(len(self.joints))
        return position, rotation, np.array([[columns[i, j] for j in count] for i in range(6)])


def _frame(kdl: Any, pose: list[float]) -> Any:
    return kdl.Frame(kdl.Rotation.Quaternion(*pose[3:]), kdl.Vector(*pose[:3]))
