# SPDX-License-Identifier: BSD-3-Clause
"""Local planning: the arc that follows the path best without touching obstacles, and the speed on it.

As the dynamic window approach (Fox, Burgard, Thrun 1997) it compares arcs of constant curvature by simulating them; it
regulates the speed by curvature, clearance and braking distance (Macenski et al. 2023, regulated pure pursuit).
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, field

import cv2
import numpy as np
import numpy.typing as npt

from bubblesim.navigation.driver import Driver
from bubblesim.navigation.planar import Point

Array = npt.NDArray[np.float64]

CELL = 0.02  # m, of the distance field
STEP = 0.05  # m along an arc between the poses that are checked
CURVES = 41  # number of arcs
TIGHTEST = 0.15  # m, radius of the tightest arc of robots that turn in place
MARGIN = 0.02  # m, minimum distance of robot and obstacles


@dataclass(frozen=True)
class Body:
    """The outline of a robot as discs along its x axis. Lengths in m."""

    radius: float  # of the discs
    centres: tuple[float, ...] = (0.0,)  # x of the discs

    @classmethod
    def rectangle(cls, length: float, width: float, discs: int = 3) -> Body:
        """Cover a rectangle around the origin by discs: the corners exactly, the sides with room to spare."""
        half = length / discs / 2
        centres = tuple(-length / 2 + half + 2 * half * index for index in range(discs))
        return cls(math.hypot(half, width / 2), centres)

    @property
    def reach(self) -> float:
        """Return the radius of the circle that the body sweeps in a turn in place."""
        return max(map(abs, self.centres)) + self.radius


@dataclass
class DistanceField:
    """Distances to the nearest obstacle on a square around the robot, in its frame."""

    half: float  # m, half the length of the square
    distances: npt.NDArray[np.float32] = field(repr=False)

    @classmethod
    def around(cls, obstacles: Array, half: float) -> DistanceField:
        """Make the field of points, n x 2."""
        size = 2 * math.ceil(half / CELL)
        free = np.full((size, size), 255, dtype=np.uint8)
        if len(obstacles):
            indices = np.floor((obstacles + half) / CELL).astype(int)
            indices = indices[((indices >= 0) & (indices < size)).all(axis=1)]
            free[indices[:, 1], indices[:, 0]] = 0
        if free.all():
            return cls(half, np.full((size, size), 2 * half, dtype=np.float32))
        return cls(half, cv2.distanceTransform(free, cv2.DIST_L2, 5) * np.float32(CELL))

    def at(self, x: Array, y: Array) -> npt.NDArray[np.float32]:
        """Return the distances at points; beyond the square those at its border."""
        last = len(self.distances) - 1
        columns = np.clip(((x + self.half) / CELL).astype(int), 0, last)
        rows = np.clip(((y + self.half) / CELL).astype(int), 0, last)
        found: npt.NDArray[np.float32] = self.distances[rows, columns]
        return found


def clearance(distances: DistanceField, body: Body, x: Array, y: Array, heading: Array) -> npt.NDArray[np.float32]:
    """Return the distance of the body to obstacles at poses, m; at most 0 where they touch."""
    cosine, sine = np.cos(heading), np.sin(heading)
    found = [distances.at(x + centre * cosine, y + centre * sine) for centre in body.centres]
    return np.asarray(np.minimum.reduce(found) - np.float32(body.radius))


@dataclass(frozen=True)
class Arc:
    """The chosen arc."""

    curvature: float  # 1/m, to the left
    free: float  # m that can be driven on it
    room: float  # m, smallest clearance on the way to the target
    miss: float  # m, distance at which it passes the target


def best_arc(
    target: Point, distances: DistanceField, body: Body, driver: Driver, previous: float, reverse: bool = False
) -> Arc | None:
    """Return the arc that comes nearest to a point in the robot's frame, None if all are blocked.

    :param previous: curvature of the last arc, 1/m: similar ones are preferred.
    :param reverse: drive backwards.
    """
    tightest = 1.0 / max(driver.turning_radius, TIGHTEST)
    spread = np.linspace(-1.0, 1.0, CURVES)
    curvatures = tightest * np.sign(spread) * spread**2  # finer around straight on
    length = min(math.hypot(*target) * 1.3, distances.half - body.reach) + STEP
    along = np.arange(STEP, length + STEP, STEP) * (-1.0 if reverse else 1.0)
    angles = curvatures[:, None] * along
    half = angles / 2
    chords = along * np.sinc(half / math.pi)
    x, y = chords * np.cos(half), chords * np.sin(half)
    room = clearance(distances, body, x, y, angles)
    blocked = room < MARGIN
    here = float(clearance(distances, body, np.zeros(1), np.zeros(1), np.zeros(1))[0])
    if here < MARGIN:  # already closer: it may drive where it does not come nearer
        blocked = room < np.minimum(here, MARGIN) - 0.005
    count = np.where(blocked.any(axis=1), blocked.argmax(axis=1), along.size)
    usable = np.arange(along.size) < count[:, None]
    away = np.where(usable, np.hypot(x - target[0], y - target[1]), np.inf)
    nearest = away.argmin(axis=1)
    before = np.arange(along.size) <= nearest[:, None]
    tight = np.clip(1.0 - room / 0.25, 0.0, None)  # closer than 0.25 m
    mean_tight = (tight * before).sum(axis=1) / (nearest + 1)
    cost = away.min(axis=1) + 0.15 * mean_tight + 0.02 * np.abs(curvatures - previous) + 0.005 * np.abs(curvatures)
    best = int(cost.argmin())
    if not math.isfinite(cost[best]):
        return None
    least = float(room[best, : nearest[best] + 1].min())
    return Arc(float(curvatures[best]), float(count[best] * STEP), least, float(away[best].min()))


def speed_on(arc: Arc, driver: Driver, remaining: float) -> float:
    """Return the speed, m/s, at which the robot can follow an arc and stop at its end and at the goal."""
    braking = max(min(arc.free - 0.05, remaining), 0.02)
    speed = min(driver.max_speed, math.sqrt(2 * driver.acceleration * braking))
    curvature = max(abs(arc.curvature), 1e-6)
    speed = min(speed, driver.max_turn / curvature, math.sqrt(driver.acceleration / curvature))
    return speed * float(np.clip(0.35 + arc.room / 0.2, 0.35, 1.0))


def can_turn(distances: DistanceField, body: Body, angle: float) -> bool:
    """Return whether the body can turn in place by an angle, rad."""
    headings = np.linspace(0.0, angle, max(int(abs(angle) / 0.1), 1) + 1, dtype=np.float64)[1:]
    zeros = np.zeros_like(headings)
    here = float(clearance(distances, body, np.zeros(1), np.zeros(1), np.zeros(1))[0])
    return bool((clearance(distances, body, zeros, zeros, headings) > min(MARGIN / 2, here - 0.005)).all())


def carrot(path: Sequence[Point], here: Point, lookahead: float) -> tuple[Point, float]:
    """Return the point of the path at a distance ahead, and the length of the path that remains."""
    points = np.asarray(path)
    away = np.hypot(points[:, 0] - here[0], points[:, 1] - here[1])
    nearest = int(away.argmin())
    ahead = np.flatnonzero(away[nearest:] >= lookahead)
    index = nearest + int(ahead[0]) if ahead.size else len(path) - 1
    rest = points[nearest:]
    length = float(np.hypot(*np.diff(rest, axis=0).T).sum()) if len(rest) > 1 else 0.0
    return (float(points[index, 0]), float(points[index, 1])), length + float(away[nearest])
