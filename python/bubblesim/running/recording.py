# SPDX-License-Identifier: BSD-3-Clause
"""Data of a run: poses over time, sonar readings, and statistics of them. Independent of ROS."""

from __future__ import annotations

import itertools
import math
from dataclasses import dataclass, field


@dataclass(frozen=True)
class Pose:
    """Pose of the robot, metres and radians in the scene's frame."""

    x: float
    y: float
    z: float
    heading: float


@dataclass(frozen=True)
class Sample:
    """A pose with its times."""

    wall_time: float  # s
    sim_time: float  # s
    pose: Pose


@dataclass
class Recording:
    """Recorded data of a run."""

    samples: list[Sample] = field(default_factory=list)
    sonar: float | None = None  # last reading, m; +Inf without an echo, None without a sonar
    closest: float = math.inf  # m

    def add_sonar(self, distance: float) -> None:
        """Add a reading, m."""
        self.sonar = distance
        self.closest = min(self.closest, distance)

    def distance(self) -> float:
        """Return the length of the path, m."""
        points = [(sample.pose.x, sample.pose.y, sample.pose.z) for sample in self.samples]
        return sum(math.dist(a, b) for a, b in itertools.pairwise(points))

    def sim_duration(self) -> float:
        """Return the simulated time between the first and the last sample, s."""
        return self.samples[-1].sim_time - self.samples[0].sim_time if self.samples else 0.0

    def real_time_factor(self, window: float = math.inf) -> float:
        """Return simulated seconds per second, over the last `window` seconds of wall time; NaN while unknown."""
        if not self.samples:
            return math.nan
        last = self.samples[-1]
        first = last
        for sample in reversed(self.samples):
            if last.wall_time - sample.wall_time > window:
                break
            first = sample
        wall = last.wall_time - first.wall_time
        return (last.sim_time - first.sim_time) / wall if wall > 0.0 else math.nan

    def live_line(self) -> str:
        """Return the current state in one line."""
        sample = self.samples[-1]
        pose = sample.pose
        parts = [
            f"t {sample.sim_time:7.2f} s",
            f"{self.real_time_factor(window=2.0):5.2f} x real time",
            f"x {pose.x:6.2f} y {pose.y:6.2f} m, heading {math.degrees(pose.heading):4.0f} deg",
        ]
        if self.sonar is not None:
            parts.append(f"sonar {self.sonar:4.2f} m" if math.isfinite(self.sonar) else "sonar no echo")
        return " | ".join(parts)

    def summary(self) -> str:
        """Return a summary of the whole run."""
        lines = [
            f"simulated time     {self.sim_duration():.2f} s",
            f"distance driven    {self.distance():.2f} m",
            f"real-time factor   {self.real_time_factor():.3f} (mean)",
        ]
        if self.sonar is not None:
            closest = f"{self.closest:.2f} m" if math.isfinite(self.closest) else "none"
            lines.append(f"closest echo       {closest}")
        return "\n".join(lines)
