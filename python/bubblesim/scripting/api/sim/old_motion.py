# SPDX-License-Identifier: BSD-3-Clause
"""`sim` functions for motions of older scripts."""

from __future__ import annotations

from typing import Any

from bubblesim.geometry import poses, rotations
from bubblesim.scripting.api.kinds import Handle, Integers, Numbers, NumbersOrNothing
from bubblesim.scripting.api.sim.motion import MotionFunctions, sized
from bubblesim.scripting.api.sim.trajectories import Trajectory
from bubblesim.scripting.api.waiting_functions import Waiting, waits


class OldMotionFunctions(MotionFunctions):
    """Motions of scripts before CoppeliaSim 4.2. Those named ...move... take their time, as in Motion."""

    @waits
    def rmlMoveToJointPositions(
        self,
        joints: Integers,
        flags: int,
        velocity: NumbersOrNothing,
        acceleration: NumbersOrNothing,
        max_velocity: Numbers,
        max_acceleration: Numbers,
        max_jerk: NumbersOrNothing = None,
        target: NumbersOrNothing = None,
        target_velocity: NumbersOrNothing = None,
        direction: object = None,
    ) -> Waiting:
        """Move joints to target positions (old style); return 0, positions, velocities, accelerations, time left."""
        if target is None:
            raise TypeError("sim.rmlMoveToJointPositions: target positions are needed")
        count = len(joints)
        motion = Trajectory(
            ([self.getJointPosition(joint) for joint in joints], sized(velocity, count), sized(acceleration, count)),
            (max_velocity, max_acceleration, max_jerk or [0.0] * count),
            (target, sized(target_velocity, count)),
            flags=max(0, flags),
        )
        positions, velocities, accelerations = yield from self._follow(motion, 0.0, self._joint_mover(joints))
        return 0, positions, velocities, accelerations, motion.time_left

    @waits
    def moveToJointPositions(
        self,
        joints: Integers,
        target: Numbers,
        velocity: float = 1.0,
        acceleration: float = 0.0,
        angular_velocity: float = 0.0,
    ) -> Waiting:
        """Move joints together to target positions (old style); ``velocity`` in rad/s or m/s. Return the time left."""
        count = len(joints)
        limits = [velocity] * count, [acceleration or 1e3 * velocity] * count, [0.0] * count
        now = [self.getJointPosition(joint) for joint in joints]
        motion = Trajectory((now, [0.0] * count, [0.0] * count), limits, (target, [0.0] * count), flags=1)
        yield from self._follow(motion, 0.0, self._joint_mover(joints))
        return motion.time_left

    @waits
    def rmlMoveToPosition(
        self,
        handle: Handle,
        relative_to: Handle,
        flags: int,
        velocity: NumbersOrNothing,
        acceleration: NumbersOrNothing,
        max_velocity: Numbers,
        max_acceleration: Numbers,
        max_jerk: NumbersOrNothing = None,
        position: NumbersOrNothing = None,
        quaternion: NumbersOrNothing = None,
        target_velocity: NumbersOrNothing = None,
    ) -> Waiting:
        """Move an object straight to a position and orientation (old style); return 0, position, quaternion, velocity,
        acceleration and the time left. Limits are for x, y, z and the angle."""
        now = self.getObjectPose(handle, relative_to)
        target = [*(position or now[:3]), *(quaternion or now[3:])]

        def move(pose: list[float], *_: Any) -> None:
            self.setObjectPose(handle, pose, relative_to)

        limits = max_velocity, max_acceleration, max_jerk
        end, left = yield from self._move_pose(max(0, flags), now, target, limits, None, 0.0, move)
        return 0, end[:3], end[3:], [0.0] * 4, [0.0] * 4, left

    @waits
    def moveToPosition(
        self,
        handle: Handle,
        relative_to: Handle,
        position: NumbersOrNothing = None,
        orientation: NumbersOrNothing = None,
        velocity: float = 1.0,
        acceleration: float = 0.0,
        mode: object = None,
        angular_velocity: object = None,
    ) -> Waiting:
        """Move an object straight to a position and to Euler angles (old style); return the time left."""
        now = self.getObjectPose(handle, relative_to)
        target = [*(position or now[:3]), *(rotations.quaternion_of_euler(orientation) if orientation else now[3:])]
        most = acceleration or 1e3 * velocity

        def move(pose: list[float], *_: Any) -> None:
            self.setObjectPose(handle, pose, relative_to)

        limits = [velocity] * 4, [most] * 4, [0.0] * 4
        _, left = yield from self._move_pose(0, now, target, limits, [1.0, 1.0, 1.0, 0.1], 0.0, move)
        return left

    @waits
    def moveToObject(
        self,
        handle: Handle,
        target: Handle,
        what: int = 3,
        relative_distance: float = 1.0,
        velocity: float = 1.0,
        acceleration: float = 0.0,
    ) -> Waiting:
        """Move an object straight to the pose of another one (old style); return the time left. ``what``: 1 position, 2
        orientation, 3 both."""
        now, end = self.getObjectPose(handle), self.getObjectPose(target)
        end = poses.interpolate(now, end, relative_distance)
        goal = [*(end[:3] if what & 1 else now[:3]), *(end[3:] if what & 2 else now[3:])]
        limits = [velocity] * 4, [acceleration or 1e3 * velocity] * 4, [0.0] * 4

        def move(pose: list[float], *_: Any) -> None:
            self.setObjectPose(handle, pose)

        _, left = yield from self._move_pose(0, now, goal, limits, [1.0, 1.0, 1.0, 0.1], 0.0, move)
        return left

    def rmlPos(
        self,
        axes: int,
        cycle_time: float,
        flags: int,
        state: Numbers,
        limits: Numbers,
        selection: Any,
        target: Numbers,
        more: object = None,
    ) -> int:
        """Prepare a motion to positions (old name of ruckigPos)."""
        return self.ruckigPos(axes, cycle_time, flags, state, limits, selection, target)

    def rmlVel(
        self,
        axes: int,
        cycle_time: float,
        flags: int,
        state: Numbers,
        limits: Numbers,
        selection: Any,
        target: Numbers,
        more: object = None,
    ) -> int:
        """Prepare a motion to velocities (old name of ruckigVel)."""
        return self.ruckigVel(axes, cycle_time, flags, state, limits, selection, target)

    def rmlStep(self, motion: int, cycle_time: float) -> tuple[int, list[float], float]:
        """Advance a motion (old name of ruckigStep)."""
        return self.ruckigStep(motion, cycle_time)

    def rmlRemove(self, motion: int) -> None:
        """Forget a motion (old name of ruckigRemove)."""
        self.ruckigRemove(motion)
