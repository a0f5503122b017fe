# SPDX-License-Identifier: BSD-3-Clause
"""Cliff sensor readings and bumper events of the Kobuki."""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence

from bubblesim.geometry.rotations import heading_of

SIDES = {"left": 0, "center": 1, "right": 2}  # kobuki_msgs: LEFT, CENTER, RIGHT of bumpers and of cliff sensors

_LOWEST, _HIGHEST = 0.01, 0.13  # m above the model's origin: range of heights at which a contact presses a bumper
_MIDDLE, _END = math.pi / 6, math.pi / 2  # rad from straight ahead: end of the middle bumper, and of the side bumpers
_MAX = 0xFFFF  # maximum of a uint16


def cliff_reading(distance: float) -> int:
    """Return the sensor's A/D converter reading at a distance in metres, by the formula of the Kobuki's plugin."""
    return min(int(76123.0 * math.atan2(0.995, distance)), _MAX)


def bumpers_pressed(pose: Sequence[float], contacts: Iterable[tuple[Sequence[float], Sequence[float]]]) -> set[str]:
    """Return the sides at which contacts press a bumper; each is 60 degrees wide.

    :param pose: pose of the model, x, y, z, qx, qy, qz, qw.
    :param contacts: positions and normals, towards the robot; all in world axes.
    """
    pressed = set()
    for position, normal in contacts:
        if not _LOWEST <= position[2] - pose[2] <= _HIGHEST or math.hypot(normal[0], normal[1]) < 0.5:
            continue
        angle = math.remainder(math.atan2(-normal[1], -normal[0]) - heading_of(*pose[3:]), math.tau)
        if abs(angle) <= _MIDDLE:
            pressed.add("center")
        elif abs(angle) <= _END:
            pressed.add("left" if angle > 0 else "right")
    return pressed
