# SPDX-License-Identifier: BSD-3-Clause
"""`sim` functions for joints."""

from __future__ import annotations

import math
from typing import Any

from bubblesim._core import MotorMode, WrongObject
from bubblesim.scripting.api.checked_calls import refusal_warns
from bubblesim.scripting.api.kinds import Handle, Numbers
from bubblesim.scripting.api.sim.context import ApiContext


class JointFunctions(ApiContext):
    """Radians and N m for revolute joints, metres and N for prismatic joints."""

    def getJointPosition(self, joint: Handle) -> float:
        """Return the joint position."""
        return float(self._world.joint_position(self._resolve(joint)))

    def setJointPosition(self, joint: Handle, position: float) -> None:
        """Set the joint position at once; for a position-controlled joint, also set the target position."""
        joint = self._resolve(joint)
        self._world.set_joint_position(joint, position)
        if self._world.is_kinematic(joint):
            self._tree.note_poses(joint)
        if self._world.motor_mode(joint) == MotorMode.POSITION:
            self._world.set_target_position(joint, position)

    def getJointInterval(self, joint: Handle) -> tuple[bool, list[float]]:
        """Return whether the joint has no limits, and [lower limit, range]."""
        lower, upper = self._world.joint_limits(self._resolve(joint))
        if not math.isfinite(upper - lower):
            return True, [-math.pi, math.tau]
        return False, [lower, upper - lower]

    @refusal_warns
    def setJointInterval(self, joint: Handle, cyclic: bool, interval: Numbers) -> None:
        """Set the limits of a joint that a script created: whether it has none, and [lower limit, range]."""
        joint = self._resolve(joint)
        if not cyclic and (len(interval) != 2 or not interval[1] >= 0):
            raise ValueError(f"an interval is a lower limit and a range of at least 0, found {interval}")
        if not self._tree.is_created_dummy(joint):
            raise WrongObject(f"{self._tree.short_path(joint)} has the limits of its file")
        limits = (-math.inf, math.inf) if cyclic else (interval[0], interval[0] + interval[1])
        self._world.set_joint_limits(joint, *limits)

    def getJointType(self, joint: Handle) -> int:
        """Return sim.joint_revolute, joint_prismatic or joint_spherical; revolute for joints with several axes."""
        kinds = {"prismatic": self.joint_prismatic, "ball": self.joint_spherical}
        return kinds.get(self._world.joint_type(self._resolve(joint)), self.joint_revolute)

    def getJointMode(self, joint: Handle) -> tuple[int, int]:
        """Return sim.jointmode_dynamic for joints moved by physics, otherwise sim.jointmode_kinematic, and 0."""
        joint = self._resolve(joint)
        is_held = joint in self._edits.held_joints or self._world.is_kinematic(joint)
        is_still = is_held or self._world.joint_type(joint) == "fixed"
        return (self.jointmode_kinematic if is_still else self.jointmode_dynamic), 0

    def getJointVelocity(self, joint: Handle) -> float:
        """Return the joint velocity."""
        return float(self._world.joint_velocity(self._resolve(joint)))

    def getJointForce(self, joint: Handle) -> float:
        """Return the force or torque of the joint's motor in the last step, positive in the joint's direction.
        Forces of limits and friction are not included."""
        return float(self._world.motor_effort(self._resolve(joint)))

    def getJointTargetPosition(self, joint: Handle) -> float:
        """Return the target position of a position-controlled joint."""
        return float(self._world.target_position(self._resolve(joint)))

    def setJointTargetPosition(self, joint: Handle, position: float, motion: Any = None) -> None:
        """Set the target position of a position-controlled joint. ``motion`` is for kinematic joints: ignored."""
        self._world.set_target_position(self._resolve(joint), position)

    def getJointTargetVelocity(self, joint: Handle) -> float:
        """Return the target velocity of a velocity-controlled joint."""
        return float(self._world.target_velocity(self._resolve(joint)))

    def setJointTargetVelocity(self, joint: Handle, velocity: float, motion: Any = None) -> None:
        """Set the target velocity of a velocity-controlled joint. ``motion`` is for kinematic joints: ignored."""
        self._world.set_target_velocity(self._resolve(joint), velocity)

    def getJointTargetForce(self, joint: Handle) -> float:
        """Return the target force or torque of a force-controlled joint, and the maximum of the motor of others."""
        joint = self._resolve(joint)
        by_force = self._world.motor_mode(joint) == MotorMode.EFFORT
        return float(self._world.target_effort(joint) if by_force else self._world.max_force(joint))

    def setJointTargetForce(self, joint: Handle, force: float, signed: bool = True) -> None:
        """Set the force or torque of a force-controlled joint, within the limit of its motor; of other joints the limit
        of the motor, without the sign. If ``signed`` is false, the target velocity gives the direction."""
        joint = self._resolve(joint)
        if self._world.motor_mode(joint) != MotorMode.EFFORT:
            self._world.set_max_force(joint, abs(force))
        elif signed:
            self._world.set_target_effort(joint, force)
        else:
            self._world.set_target_effort(joint, math.copysign(force, self._world.target_velocity(joint)))

    def setJointMaxForce(self, joint: Handle, force: float) -> None:
        """Set the maximum force or torque of the joint's motor (old name)."""
        self.setJointTargetForce(joint, force, False)

    def setJointForce(self, joint: Handle, force: float, signed: bool = True) -> None:
        """The same as setJointTargetForce (old name)."""
        self.setJointTargetForce(joint, force, signed)

    def getJointMaxForce(self, joint: Handle) -> float:
        """Return the maximum force or torque of the joint's motor (old name)."""
        return float(self._world.max_force(self._resolve(joint)))

    @refusal_warns
    def setJointMode(self, joint: Handle, mode: int, options: int = 0) -> None:
        """Let physics move a joint (sim.jointmode_dynamic), or only setJointPosition (sim.jointmode_kinematic).

        A kinematic joint that connects bodies is held at its position with any force that this takes. The end of the
        run brings back its mode. A joint that moves no body stays kinematic.
        """
        joint = self._resolve(joint)
        is_dynamic = mode == self.jointmode_dynamic
        if is_dynamic == (self.getJointMode(joint)[0] == self.jointmode_dynamic):
            return
        if self._world.is_kinematic(joint) or self._world.joint_type(joint) in ("fixed", "ball"):
            path = self._tree.short_path(joint)
            raise WrongObject(f"the mode of {path} cannot be changed: physics moves nothing by it, or only as a whole")
        if is_dynamic:
            motor, force = self._edits.held_joints.pop(joint)
            self._world.set_motor_mode(joint, motor)
            self._world.set_max_force(joint, force)
            return
        self._edits.held_joints[joint] = (self._world.motor_mode(joint), self._world.max_force(joint))
        self._world.set_target_position(joint, self._world.joint_position(joint))
        self._world.set_motor_mode(joint, MotorMode.POSITION)
        self._world.set_max_force(joint, math.inf)

    def _control_modes(self) -> dict[int, MotorMode]:
        return {
            self.jointdynctrl_free: MotorMode.NONE,
            self.jointdynctrl_force: MotorMode.EFFORT,
            self.jointdynctrl_velocity: MotorMode.VELOCITY,
            self.jointdynctrl_position: MotorMode.POSITION,
        }
