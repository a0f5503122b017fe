# SPDX-License-Identifier: BSD-3-Clause
"""Sensors whose messages name a frame in which they do not measure."""

from __future__ import annotations

import math
import sys
from typing import Any

import bubblesim
from bubblesim import _core

_NEAR = 1e-3  # m and rad


def report_sensor_frames(simulation: bubblesim.Simulation) -> int:
    """Write a warning for each sensor with a topic and no frame whose pose is not that of its link; return how many."""
    world: Any = simulation.world
    count = 0
    for model in world.models:
        for sensor in world.parts(model, "sensor"):
            topic, frame, _ = world.sensor_topic(sensor)
            link = world.carrier(sensor)
            if not topic or frame:
                continue
            why = _difference(world.pose_in(sensor, link))
            if not why and str(_core.sensor_kind(simulation, sensor)) == "camera":
                why = "images have an optical frame, z forward (REP 103)"
            if why:
                count += 1
                print(
                    f"warning: {world.path(sensor)}: {topic} is in the frame {world.name(link)}, but {why}: "
                    f"<bubblesim:frame>{world.name(sensor)}</bubblesim:frame> gives it a frame of its own",
                    file=sys.stderr,
                )
    return count


def _difference(pose: list[float]) -> str:
    """Return how a pose differs from that of its frame; empty if it does not."""
    distance, angle = math.hypot(*pose[:3]), 2.0 * math.atan2(math.hypot(*pose[3:6]), abs(pose[6]))
    if distance > _NEAR:
        return f"the sensor is {distance:.3g} m from it"
    return f"the sensor is turned by {angle:.3g} rad" if angle > _NEAR else ""
