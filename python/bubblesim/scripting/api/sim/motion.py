# SPDX-License-Identifier: BSD-3-Clause
"""`sim` functions for motion profiles."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from typing import Any

from bubblesim._core import MotorMode
from bubblesim.geometry import poses, rotations
from bubblesim.scripting.api.kinds import Numbers, NumbersOrNothing
from bubblesim.scripting.api.sim.joints import JointFunctions
from bubblesim.scripting.api.sim.objects import ObjectFunctions
from bubblesim.scripting.api.sim.trajectories import WORKING, Trajectory
from bubblesim.scripting.api.waiting_functions import Waiting, waits

_MOST_MOTIONS = 10_000
_NOTHING: list[float] = []


class MotionFunctions(ObjectFunctions, JointFunctions):
    """Motions within limits of velocity, acceleration and jerk, by Ruckig. Those named move... take their time: they
    are for sysCall_thread, coroutines and remote clients. Callbacks are functions or names of functions."""

    @waits
    def moveToConfig(
        self,
        flags: Any,
        position: NumbersOrNothing = None,
        velocity: NumbersOrNothing = None,
        acceleration: NumbersOrNothing = None,
        max_velocity: NumbersOrNothing = None,
        max_acceleration: NumbersOrNothing = None,
        max_jerk: NumbersOrNothing = None,
        target: NumbersOrNothing = None,
        target_velocity: NumbersOrNothing = None,
        callback: Any = None,
        data: Any = None,
        cyclic: Any = None,
        time_step: float = 0.0,
    ) -> Waiting:
        """Move joints to a configuration; return the last positions, velocities, accelerations and the time left.

        ``callback`` is called in each step with positions, velocities, accelerations and ``data``, and moves the
        joints; if it returns true, the motion ends. The newer form has one table: ``joints`` (handles, moved without a
        callback) or ``pos``, and ``maxVel``, ``maxAccel``, ``maxJerk``, ``targetPos``, ``vel``, ``accel``,
        ``targetVel``, ``callback``, ``auxData``, ``flags``, ``timeStep``; then the result is a table, too."""
        if isinstance(flags, Mapping):
            return (yield from self._move_by_table(flags))
        if position is None or max_velocity is None or max_acceleration is None or target is None:
            raise TypeError("sim.moveToConfig: positions, limits of velocity and acceleration, and targets are needed")
        count = len(position)
        motion = Trajectory(
            (position, sized(velocity, count), sized(acceleration, count)),
            (max_velocity, max_acceleration, max_jerk or [0.0] * count),
            (self._nearest_turns(position, target, cyclic), sized(target_velocity, count)),
            flags=max(0, int(flags or 0)),
        )
        call = self._answering(callback)
        result = yield from self._follow(motion, time_step, lambda *state: call(*state, data))
        return (*result, motion.time_left)

    @waits
    def moveToPose(
        self,
        flags: Any,
        pose: NumbersOrNothing = None,
        max_velocity: NumbersOrNothing = None,
        max_acceleration: NumbersOrNothing = None,
        max_jerk: NumbersOrNothing = None,
        target: NumbersOrNothing = None,
        callback: Any = None,
        data: Any = None,
        metric: NumbersOrNothing = None,
        time_step: float = 0.0,
    ) -> Waiting:
        """Move a pose (7 numbers, or a matrix of 12) straight to another one; return the last pose and the time left.

        Limits are four numbers, for x, y, z and the angle; or one number with a ``metric``: factors of x, y, z and the
        angle for a common length. ``callback`` is called in each step with pose, velocity, acceleration and ``data``;
        if it returns true, the motion ends. The newer form has one table: ``object`` (a handle, moved without a
        callback) or ``pose``, and ``targetPose``, ``maxVel``, ``maxAccel``, ``maxJerk``, ``metric``, ``relObject``,
        ``callback``, ``auxData``, ``flags``, ``timeStep``; then the result is a table, too."""
        if isinstance(flags, Mapping):
            return (yield from self._move_pose_by_table(flags))
        if pose is None or max_velocity is None or max_acceleration is None or target is None:
            raise TypeError("sim.moveToPose: poses and limits of velocity and acceleration are needed")
        call = self._answering(callback)
        return (
            yield from self._move_pose(
                max(0, int(flags or 0)),
                pose,
                target,
                (max_velocity, max_acceleration, max_jerk),
                metric,
                time_step,
                lambda *state: call(*state, data),
            )
        )

    def ruckigPos(
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
        """Prepare a motion to positions and return its handle: ``state`` has positions, velocities and accelerations,
        ``limits`` velocities, accelerations and jerks, ``target`` positions and velocities, each for all axes."""
        motion = Trajectory(
            _parts(state, axes, 3),
            _parts(limits, axes, 3),
            _parts(target, axes, 2),
            flags=max(0, flags),
            selection=_flags(selection),
        )
        return self._keep_motion(motion)

    def ruckigVel(
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
        """Prepare a motion to velocities and return its handle: ``limits`` has accelerations and jerks, ``target``
        velocities."""
        accelerations, jerks = _parts(limits, axes, 2)
        motion = Trajectory(
            _parts(state, axes, 3),
            ([0.0] * axes, accelerations, jerks),
            ([0.0] * axes, target),
            flags=max(0, flags),
            selection=_flags(selection),
            by_velocity=True,
        )
        return self._keep_motion(motion)

    def ruckigStep(self, motion: int, cycle_time: float) -> tuple[int, list[float], float]:
        """Advance a motion by a time in s; return 0 (1 at its end), positions, velocities and accelerations of all axes
        in one list, and the duration of the motion."""
        trajectory = self._motion(motion)
        done, positions, velocities, accelerations = trajectory.advance(cycle_time)
        return done, [*positions, *velocities, *accelerations], trajectory.duration

    def ruckigRemove(self, motion: int) -> None:
        """Forget a motion."""
        self._motion(motion)
        del self._motions[motion]

    def _follow(self, motion: Trajectory, time_step: float, call: Callable[..., Any]) -> Waiting:
        while True:
            done, *state = motion.advance(time_step or float(self._simulation.time_step))
            ends = call(*state)
            if done != WORKING or ends is True:
                return tuple(state)
            yield

    def _move_by_table(self, table: Mapping[str, Any]) -> Waiting:
        joints = [int(joint) for joint in table.get("joints", ())]
        position = list(table.get("pos") or [self.getJointPosition(joint) for joint in joints])
        count = len(position)
        target = _needed(table, "targetPos", "moveToConfig")
        motion = Trajectory(
            (position, sized(table.get("vel"), count), sized(table.get("accel"), count)),
            (
                _needed(table, "maxVel", "moveToConfig"),
                _needed(table, "maxAccel", "moveToConfig"),
                list(table.get("maxJerk") or [0.0] * count),
            ),
            (target, sized(table.get("targetVel"), count)),
            flags=max(0, int(table.get("flags") or 0)),
        )
        mover = self._joint_mover(joints) if joints and not table.get("callback") else None
        call = self._answering(table.get("callback"))

        def each(positions: list[float], velocities: list[float], accelerations: list[float]) -> Any:
            if mover is not None:
                return mover(positions)
            now = {"pos": positions, "vel": velocities, "accel": accelerations, "auxData": table.get("auxData")}
            return call({"joints": joints, **now})

        positions, velocities, accelerations = yield from self._follow(motion, float(table.get("timeStep") or 0), each)
        ended = {"pos": positions, "vel": velocities, "accel": accelerations, "timeLeft": motion.time_left}
        return {"joints": joints, **ended}

    def _move_pose_by_table(self, table: Mapping[str, Any]) -> Waiting:
        frame = int(table.get("relObject", self.handle_world))
        handle = table.get("object")
        start = table.get("pose") or (self.getObjectPose(int(handle), frame) if handle is not None else None)
        if start is None:
            raise TypeError("sim.moveToPose: 'object' or 'pose' is needed")
        call = self._answering(table.get("callback"))

        def each(pose: list[float], velocity: Any, acceleration: Any) -> Any:
            if table.get("callback"):
                return call({"pose": pose, "auxData": table.get("auxData")})
            if handle is not None:
                self.setObjectPose(int(handle), pose, frame)
            return None

        limits = (
            _needed(table, "maxVel", "moveToPose"),
            _needed(table, "maxAccel", "moveToPose"),
            table.get("maxJerk"),
        )
        target = _needed(table, "targetPose", "moveToPose")
        step = float(table.get("timeStep") or 0)
        flags = max(0, int(table.get("flags") or 0))
        end, left = yield from self._move_pose(flags, list(start), target, limits, table.get("metric"), step, each)
        return {"pose": end, "timeLeft": left}

    def _move_pose(
        self,
        flags: int,
        start: list[float],
        target: list[float],
        limits: tuple[list[float], list[float], list[float] | None],
        metric: list[float] | None,
        time_step: float,
        call: Callable[..., Any],
    ) -> Waiting:
        """Move a pose: x, y, z and the share of the rotation each have a profile, or with a metric all one."""
        as_matrix = len(start) == 12
        begin = poses.of_matrix(start) if as_matrix else list(start)
        end = poses.of_matrix(target) if len(target) == 12 else list(target)
        _, angle = poses.axis_angle(poses.multiply(poses.inverse(begin), end)[3:])
        way = [b - a for a, b in zip(begin[:3], end[:3], strict=True)]
        if metric is None:
            lengths, signs = [*map(abs, way), abs(angle)], [*(math.copysign(1, w) for w in way), 1.0]
            axes = limits
        else:
            weighted = [w * float(factor) for w, factor in zip([*way, angle], metric, strict=True)]
            lengths, signs = [math.hypot(*weighted)], [1.0]
            axes = (limits[0][:1], limits[1][:1], None if limits[2] is None else limits[2][:1])
        count = len(lengths)
        jerks = [0.0] * count if axes[2] is None else list(axes[2])[:count]
        zeros = [0.0] * count
        motion = Trajectory(
            (zeros, zeros, zeros),
            (list(axes[0])[:count], list(axes[1])[:count], jerks),
            ([length * sign for length, sign in zip(lengths, signs, strict=True)], zeros),
            flags=flags,
        )
        pose = begin

        def each(done: list[float], velocities: list[float], accelerations: list[float]) -> Any:
            nonlocal pose
            shares = [now / whole if whole else 1.0 for now, whole in zip(done, lengths, strict=True)]
            if metric is None:
                position = [a + now for a, now in zip(begin[:3], done[:3], strict=True)]
                turned = poses.interpolate(begin, end, min(max(shares[3], 0.0), 1.0))[3:]
            else:
                between = poses.interpolate(begin, end, min(max(shares[0], 0.0), 1.0))
                position, turned = between[:3], between[3:]
            pose = [*position, *turned]
            return call(rotations.matrix_of_pose(pose) if as_matrix else pose, velocities, accelerations)

        yield from self._follow(motion, time_step, each)
        return (rotations.matrix_of_pose(pose) if as_matrix else pose), motion.time_left

    def _answering(self, callback: Any) -> Callable[..., Any]:
        """Return a callback that returns what the script's function does."""
        if callback is None:
            return lambda *_: None
        if callable(callback) and not self._caller.is_remote:
            return callback  # type: ignore[no-any-return]  # runs inside of the script's own call
        return self._caller.callback(callback)

    def _joint_mover(self, joints: list[int]) -> Callable[..., None]:
        """Return a function that moves joints: those that control their position by their target, others at once."""
        handles = [self._resolve(joint) for joint in joints]
        by_target = [self._world.motor_mode(joint) == MotorMode.POSITION for joint in handles]

        def move(positions: list[float], *_: Any) -> None:
            for joint, is_controlled, position in zip(handles, by_target, positions, strict=True):
                (self._world.set_target_position if is_controlled else self._world.set_joint_position)(joint, position)

        return move

    def _nearest_turns(self, now: list[float], target: list[float], cyclic: Any) -> list[float]:
        """Return targets without more than half a turn for joints that have no limits."""
        if not isinstance(cyclic, list | tuple):
            return target
        found = list(target)
        for number, is_cyclic in enumerate(cyclic[: len(found)]):
            if is_cyclic:
                found[number] = now[number] + math.remainder(target[number] - now[number], math.tau)
        return found

    def _motion(self, handle: int) -> Trajectory:
        if handle not in self._motions:
            raise LookupError(f"no motion has the handle {handle}")
        motion: Trajectory = self._motions[handle]
        return motion

    def _keep_motion(self, motion: Trajectory) -> int:
        kept = self._motions
        if len(kept) >= _MOST_MOTIONS:
            raise ValueError(f"a script has at most {_MOST_MOTIONS} motions: remove some")
        handle = max(kept, default=-1) + 1
        kept[handle] = motion
        return handle


def _needed(table: Mapping[str, Any], name: str, function: str) -> list[float]:
    value = table.get(name)
    if value is None:
        raise TypeError(f"sim.{function}: '{name}' is needed")
    return [float(number) for number in value]


def sized(values: Any, count: int) -> list[float]:
    """Return numbers, or as many zeros if there are none."""
    return [float(value) for value in values] if values else [0.0] * count


def _parts(numbers: list[float], axes: int, parts: int) -> list[list[float]]:
    if len(numbers) < axes * parts:
        raise ValueError(f"{axes} axes need {axes * parts} numbers, found {len(numbers)}")
    return [numbers[axes * i : axes * (i + 1)] for i in range(parts)]


def _flags(selection: Any) -> list[float]:
    if isinstance(selection, int):
        return [bool(selection & 1 << bit) for bit in range(selection.bit_length())]
    return [bool(each) for each in selection or ()]
