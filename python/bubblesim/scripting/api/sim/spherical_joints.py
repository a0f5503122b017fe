# SPDX-License-Identifier: BSD-3-Clause
"""`sim` functions that turn spherical joints."""

from __future__ import annotations

from bubblesim.geometry import poses
from bubblesim.scripting.api.differences import differs
from bubblesim.scripting.api.kinds import Handle, Vector4, Vector12
from bubblesim.scripting.api.sim.logs import LogFunctions

_PHYSICS_TURNS = "it turns any spherical joint in kinematic mode; here physics alone turns those between bodies"


class SphericalJointFunctions(LogFunctions):
    """A spherical joint without physics turns what is below it in the tree."""

    @differs(_PHYSICS_TURNS)
    def setSphericalJointMatrix(self, joint: Handle, matrix: Vector12) -> int:
        """Turn a spherical joint to the orientation of a matrix, in the joint's frame. Return 1."""
        return self._turn(joint, poses.of_matrix(matrix)[3:])

    @differs(_PHYSICS_TURNS)
    def setSphericalJointRotation(self, joint: Handle, quaternion: Vector4) -> int:
        """Turn a spherical joint to an orientation in the joint's frame: x, y, z, w. Return 1."""
        return self._turn(joint, quaternion)

    def _turn(self, joint: int, quaternion: list[float]) -> int:
        handle = self._resolve(joint)
        if self._tree.has_body(handle):
            level = self.verbosity_scriptwarnings | self.verbosity_once
            self.addLog(level, f"sim.setSphericalJoint...: physics alone turns {self._tree.short_path(handle)}")
            return 1
        settings, key = self._caller.shared.settings, (list, f"rotation of {handle}")
        before = settings.get(key, poses.IDENTITY[3:])
        turn = poses.multiply([0.0, 0.0, 0.0, *quaternion], poses.inverse([0.0, 0.0, 0.0, *before]))
        for child in self._tree.children(handle):
            if not self._tree.has_body(child) or child in self._edits.shapes:
                self._tree.set_pose(child, poses.multiply(turn, self._tree.pose_in(child, handle)), handle)
        settings[key] = list(quaternion)
        return 1
