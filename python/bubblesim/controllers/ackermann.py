# SPDX-License-Identifier: BSD-3-Clause
"""Cars with two steered front wheels that roll without slipping (Ackermann steering)."""

import math


def front_wheel_angles(wheelbase: float, track: float, angle: float) -> tuple[float, float]:
    """Return the angles of the left and the right front wheel, rad, equivalent to one middle wheel at ``angle``.

    All wheel axles meet on the line through the rear axle (R. Rajamani, Vehicle Dynamics and Control, section 2.2).

    :param wheelbase: m, from the rear to the front axle.
    :param track: m, between the front wheels.
    :param angle: rad, to the left, less than pi/2.
    """
    tangent = math.tan(angle)
    narrower = track / 2 / wheelbase * tangent
    return math.atan2(tangent, 1.0 - narrower), math.atan2(tangent, 1.0 + narrower)


def rear_wheel_speeds(wheelbase: float, track: float, speed: float, angle: float) -> tuple[float, float]:
    """Return the rim speeds of the left and the right rear wheel, m/s, when their midpoint moves at ``speed``."""
    slower = track / 2 / wheelbase * math.tan(angle)
    return speed * (1.0 - slower), speed * (1.0 + slower)
