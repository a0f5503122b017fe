# SPDX-License-Identifier: BSD-3-Clause
"""Trajectories with limits of velocity, acceleration and jerk, computed by Ruckig (Berscheid and Kröger 2021)."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

WORKING, FINISHED, FAILED = 0, 1, -1
_NO_SYNCHRONIZATION, _TIME, _PHASE = 3, 1, 0
_HUGE = 1e9


class Trajectory:
    """A motion from a state to a target, advanced by times. Angles in rad, lengths in m."""

    def __init__(
        self,
        state: Sequence[Sequence[float]],
        limits: Sequence[Sequence[float]],
        target: Sequence[Sequence[float]],
        *,
        flags: int = 0,
        selection: Sequence[float] = (),
        by_velocity: bool = False,
    ) -> None:
        """Begin.

        :param state: positions, velocities and accelerations of the axes.
        :param limits: greatest velocities, accelerations and jerks.
        :param target: positions and velocities at the end.
        :param flags: sim.ruckig_phasesync, timesync or nosync.
        :param selection: which axes move (true); none given: all.
        :param by_velocity: the target is the velocities alone.
        :raises RuntimeError: if Ruckig is not installed.
        """
        try:
            import ruckig
        except ImportError as error:
            raise RuntimeError(f"motion profiles need the Python package ruckig ({error}): run scripts/setup") from None
        self._ruckig = ruckig
        axes = len(state[0])
        self._calculator = ruckig.Ruckig(axes)
        self._given = ruckig.InputParameter(axes)
        self._trajectory = ruckig.Trajectory(axes)
        given = self._given
        given.current_position, given.current_velocity, given.current_acceleration = map(list, state)
        given.max_velocity, given.max_acceleration, given.max_jerk = ([_positive(x) for x in each] for each in limits)
        if by_velocity:
            given.control_interface = ruckig.ControlInterface.Velocity
            given.target_velocity = list(target[1])
        else:
            given.target_position, given.target_velocity = map(list, target)
        kinds = {_NO_SYNCHRONIZATION: ruckig.Synchronization.No, _TIME: ruckig.Synchronization.Time}
        given.synchronization = kinds.get(flags & 3, ruckig.Synchronization.Phase)
        if selection and not all(selection):
            given.enabled = [bool(each) for each in selection]
        self._time = 0.0
        self._begin()

    def _begin(self) -> None:
        try:
            result = self._calculator.calculate(self._given, self._trajectory)
        except Exception as error:
            raise ValueError(f"there is no such motion: {' '.join(str(error).split())}") from None
        if result not in (self._ruckig.Result.Working, self._ruckig.Result.Finished):
            raise ValueError(f"there is no such motion: {result.name}: check that limits and targets fit each other")

    @property
    def duration(self) -> float:
        """The time that the motion takes, s."""
        return float(self._trajectory.duration)

    @property
    def time_left(self) -> float:
        """How much longer than the motion it was advanced, as a negative time; 0 before its end."""
        return min(0.0, self.duration - self._time)

    def advance(self, seconds: float) -> tuple[int, list[float], list[float], list[float]]:
        """Go on by a time; return WORKING or FINISHED, and positions, velocities and accelerations."""
        self._time += seconds
        position, velocity, acceleration = self._trajectory.at_time(self._time)[:3]
        done = FINISHED if self._time >= self.duration else WORKING
        return done, list(position), list(velocity), list(acceleration)


def _positive(limit: Any) -> float:
    """Return a limit; jerks and accelerations of 0, which scripts give for none, are huge."""
    return min(abs(float(limit)), _HUGE) or _HUGE
