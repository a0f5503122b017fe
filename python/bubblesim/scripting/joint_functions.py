# SPDX-License-Identifier: BSD-3-Clause
"""`sim` functions that read and drive joints."""

from __future__ import annotations

from bubblesim.scripting.context import ApiContext, as_number


class JointFunctions(ApiContext):
    """Radians and N m for joints that turn, metres and N for joints that slide."""

    def getJointPosition(self, handle: int) -> float:
        """Angle or distance from the joint's zero."""
        return float(self._world.joint_position(self._resolve(handle)))

    def getJointVelocity(self, handle: int) -> float:
        """Velocity of the joint."""
        return float(self._world.joint_velocity(self._resolve(handle)))

    def getJointTargetPosition(self, handle: int) -> float:
        """Where a position-controlled joint goes."""
        return float(self._world.target_position(self._resolve(handle)))

    def setJointTargetPosition(self, handle: int, position: float) -> None:
        """Let a position-controlled joint go to ``position``."""
        self._world.set_target_position(self._resolve(handle), as_number(position, "setJointTargetPosition"))

    def getJointTargetVelocity(self, handle: int) -> float:
        """What a velocity-controlled joint holds."""
        return float(self._world.target_velocity(self._resolve(handle)))

    def setJointTargetVelocity(self, handle: int, velocity: float) -> None:
        """Let a velocity-controlled joint turn or slide at ``velocity``."""
        self._world.set_target_velocity(self._resolve(handle), as_number(velocity, "setJointTargetVelocity"))

    def getJointTargetForce(self, handle: int) -> float:
        """The most that the joint's motor may apply."""
        return float(self._world.max_force(self._resolve(handle)))

    def setJointTargetForce(self, handle: int, force: float) -> None:
        """Limit what the joint's motor may apply."""
        self._world.set_max_force(self._resolve(handle), abs(as_number(force, "setJointTargetForce")))

    def setJointMaxForce(self, handle: int, force: float) -> None:
        """Limit what the joint's motor may apply (old name)."""
        self.setJointTargetForce(handle, force)
