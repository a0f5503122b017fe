# SPDX-License-Identifier: BSD-3-Clause
"""The recovery behaviours of move_base: what a robot does, one after the other, where no way leads on."""

from __future__ import annotations

import enum
import math
from dataclasses import dataclass

import numpy as np

from bubblesim.controllers.planar_motion import Pose2D, Velocity
from bubblesim.navigation.driver import STANDING, Driver, turn_towards
from bubblesim.navigation.local_planning import Body, DistanceField, can_turn
from bubblesim.navigation.planar import Point

_LOOK = 0.3  # rad of the turn that must be free


class RecoveryKind(enum.Enum):
    """What a behaviour does."""

    CLEAR = "clear"  # forget the obstacles that are further away than a distance
    ROTATE = "rotate"  # turn once around, to see


@dataclass(frozen=True)
class Recovery:
    """A recovery behaviour."""

    name: str
    kind: RecoveryKind
    distance: float = 0.0  # m, to which obstacles are kept


DEFAULT_RECOVERIES = (
    Recovery("conservative_reset", RecoveryKind.CLEAR, 3.0),
    Recovery("rotate_recovery", RecoveryKind.ROTATE),
    Recovery("aggressive_reset", RecoveryKind.CLEAR, 1.84),  # 4 times the radius of move_base's default footprint
    Recovery("aggressive_rotate", RecoveryKind.ROTATE),
)


class Recoveries:
    """Those that are left for a goal: all of them again once the robot has moved on."""

    def __init__(self, all_of_them: tuple[Recovery, ...], distance: float) -> None:
        """:param distance: m, after which all are left again."""
        self._all = all_of_them
        self._distance = distance
        self._done = 0
        self._place: Point | None = None  # of the last one

    def restart(self) -> None:
        """Have all of them left."""
        self._done = 0
        self._place = None

    def moved_to(self, place: Point) -> None:
        """Have all of them left if the robot has moved on."""
        if self._place is not None and math.dist(place, self._place) > self._distance:
            self.restart()

    def take(self, place: Point) -> Recovery | None:
        """Return the next one; None if none is left."""
        if self._done == len(self._all):
            return None
        self._done += 1
        self._place = place
        return self._all[self._done - 1]


class Rotation:
    """A turn in place, once around, as far as it is free."""

    def __init__(self, driver: Driver, body: Body, pose: Pose2D) -> None:
        """Begin at a pose."""
        self._driver = driver
        self._body = body
        self._last = pose.heading
        self._left = math.tau  # rad

    def update(self, pose: Pose2D, obstacles: list[Point]) -> Velocity:
        """Return the velocity; STANDING at the end.

        :param obstacles: in the robot's frame, m.
        """
        self._left -= math.remainder(pose.heading - self._last, math.tau)
        self._last = pose.heading
        points = np.array(obstacles, dtype=np.float64).reshape(-1, 2)
        nearby = DistanceField.around(points, self._body.reach + 0.1)
        if self._driver.turning_radius > 0.0 or self._left < 0.05 or not can_turn(nearby, self._body, _LOOK):
            return STANDING
        return turn_towards(self._left, self._driver)
