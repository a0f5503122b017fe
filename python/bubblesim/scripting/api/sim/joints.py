# SPDX-License-Identifier: BSD-3-Clause
"""`sim` functions that read and drive joints."""

from __future__ import annotations

import math

from bubblesim.scripting.api.kinds import Handle
from bubblesim.scripting.api.sim.context import ApiContext


class JointFunctions(ApiContext):
    """Radians and N m for joints that turn, metres and N for joints that slide."""

    def getJointPosition(self, joint: Handle) -> float:
        """Angle or distance from the joint's zero."""
        return float(self._world.joint_position(self._resolve(joint)))

    def setJointPosition(self, joint: Handle, position: float) -> None:
        """Put what hangs on a joint there at once; one whose motor holds a position should be given a target, too."""
        self._world.set_joint_position(self._resolve(joint), position)

    def getJointInterval(self, joint: Handle) -> tuple[bool, list[float]]:
        """Whether the joint has no limits, and [lowest position, range]."""
        lower, upper = self._world.joint_limits(self._resolve(joint))
        if not math.isfinite(upper - lower):
            return True, [-math.pi, math.tau]
        return False, [lower, upper - lower]

    def getJointType(self, joint: Handle) -> int:
        """sim.joint_revolute, joint_prismatic or joint_spherical; revolute for joints with several axes."""
        kinds = {"prismatic": self.joint_prismatic, "ball": self.joint_spherical}
        return kinds.get(self._world.joint_type(self._resolve(joint)), self.joint_revolute)

    def getJointMode(self, joint: Handle) -> tuple[int, int]:
        """sim.jointmode_dynamic for joints that physics move, all but fixed ones, and 0."""
        fixed = self._world.joint_type(self._resolve(joint)) == "fixed"
        return (self.jointmode_kinematic if fixed else self.jointmode_dynamic), 0

    def getJointVelocity(self, joint: Handle) -> float:
        """Velocity of the joint."""
        return float(self._world.joint_velocity(self._resolve(joint)))

    def getJointForce(self, joint: Handle) -> float:
        """What the joint's motor did in the last step, in the joint's positive direction; measured from the first call
        on, which returns 0. What holds a joint beside its motor, such as limits and friction, does not count."""
        return float(self._world.motor_effort(self._resolve(joint)))

    def getJointTargetPosition(self, joint: Handle) -> float:
        """Where a position-controlled joint goes."""
        return float(self._world.target_position(self._resolve(joint)))

    def setJointTargetPosition(self, joint: Handle, position: float) -> None:
        """Let a position-controlled joint go to ``position``."""
        self._world.set_target_position(self._resolve(joint), position)

    def getJointTargetVelocity(self, joint: Handle) -> float:
        """What a velocity-controlled joint holds."""
        return float(self._world.target_velocity(self._resolve(joint)))

    def setJointTargetVelocity(self, joint: Handle, velocity: float) -> None:
        """Let a velocity-controlled joint turn or slide at ``velocity``."""
        self._world.set_target_velocity(self._resolve(joint), velocity)

    def getJointTargetForce(self, joint: Handle) -> float:
        """The most that the joint's motor may apply."""
        return float(self._world.max_force(self._resolve(joint)))

    def setJointTargetForce(self, joint: Handle, force: float) -> None:
        """Limit what the joint's motor may apply."""
        self._world.set_max_force(self._resolve(joint), abs(force))

    def setJointMaxForce(self, joint: Handle, force: float) -> None:
        """Limit what the joint's motor may apply (old name)."""
        self.setJointTargetForce(joint, force)
