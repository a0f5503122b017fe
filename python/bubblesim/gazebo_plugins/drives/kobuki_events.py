# SPDX-License-Identifier: BSD-3-Clause
"""What the Kobuki makes of distances to the floor and of what touches it."""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence

from bubblesim.geometry.rotations import heading_of

SIDES = {"left": 0, "center": 1, "right": 2}  # of kobuki_msgs: both LEFT, CENTER and RIGHT of bumpers and cliff sensors

_LOWEST, _HIGHEST = 0.01, 0.13  # m above the model's origin, between which a contact presses a bumper
_MIDDLE, _END = math.pi / 6, math.pi / 2  # rad from straight ahead: where the bumper in the middle ends, and the others
_MOST = 0xFFFF  # of a uint16


def cliff_reading(distance: float) -> int:
    """What the sensor's converter reads at a distance in metres, by the formula of the Kobuki's plugin."""
    return min(int(76123.0 * math.atan2(0.995, distance)), _MOST)


def bumpers_pressed(pose: Sequence[float], contacts: Iterable[tuple[Sequence[float], Sequence[float]]]) -> set[str]:
    """The sides at which contacts press: each 60 degrees wide.

    :param pose: of the model, x, y, z, qx, qy, qz, qw.
    :param contacts: positions and normals, these towards the robot; all in world axes.
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
